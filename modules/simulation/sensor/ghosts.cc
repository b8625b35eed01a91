#include "saker/simulation/sensor/ghosts.h"

#include <cmath>

namespace saker::simulation {
namespace {

constexpr float kStep = 0.01F;        ///< m between the rays that find a mirror's normal
constexpr float kMirrorGloss = 0.3F;  ///< from which on a surface mirrors

struct Mirrored {
  std::size_t beam = 0;
  Shot shot;
};

/// What the lost beams met, where that mirrors; a share of them.
std::vector<Mirrored> mirrored_beams(double share, const ScanSetting& setting, core::Rng& rng,
                                     const CastScan& scan) {
  const BeamTable& beams = setting.unit->beams;
  std::vector<Mirrored> lost;
  std::vector<Shot> shots;
  for (int column = 0; column < scan.columns; ++column) {
    const Eigen::Isometry3f T = setting.T_world_lidar(column).cast<float>();
    for (int row = 0; row < scan.rows; ++row) {
      const std::size_t i = beams.index(row, column);
      if (scan.range_m[i] > 0 || !rng.chance(share)) continue;
      Shot shot;
      shot.origin = T * beams.origins[i];
      shot.direction = T.linear() * beams.directions[i];
      lost.push_back({i, shot});
      shots.push_back(shot);
    }
  }
  setting.caster->cast(shots, static_cast<float>(setting.unit->receiver.max_range_m));
  std::vector<Mirrored> mirrored;
  for (std::size_t k = 0; k < lost.size(); ++k) {
    const bool mirrors =
        shots[k].hit && setting.world->materials[shots[k].material].gloss >= kMirrorGloss;
    if (mirrors) mirrored.push_back({lost[k].beam, shots[k]});
  }
  return mirrored;
}

Eigen::Vector3f met(const Shot& shot) { return shot.origin + shot.distance * shot.direction; }

/// Each beam after its mirror; not hit: the mirror is no plane there.
std::vector<Shot> reflected(const std::vector<Mirrored>& mirrored, const RayCaster& caster,
                            float far) {
  std::vector<Shot> beside;
  for (const Mirrored& m : mirrored) {
    const Eigen::Vector3f across = m.shot.direction.unitOrthogonal();
    for (const Eigen::Vector3f& aside : {across, Eigen::Vector3f(m.shot.direction.cross(across))}) {
      Shot shot = m.shot;
      shot.origin += kStep * aside;
      shot.hit = false;
      beside.push_back(shot);
    }
  }
  caster.cast(beside, far);
  std::vector<Shot> shots;
  for (std::size_t k = 0; k < mirrored.size(); ++k) {
    const Shot& shot = mirrored[k].shot;
    const Eigen::Vector3f a = met(beside[2 * k]) - met(shot);
    const Eigen::Vector3f b = met(beside[2 * k + 1]) - met(shot);
    const Eigen::Vector3f n = a.cross(b).normalized();
    Shot next;
    next.origin = met(shot);
    next.direction = (shot.direction - 2 * shot.direction.dot(n) * n).normalized();
    next.near = 0.02F;
    const bool flat = beside[2 * k].hit && beside[2 * k + 1].hit && a.norm() < 0.5F &&
                      b.norm() < 0.5F && next.direction.allFinite();
    if (!flat) next.direction = Eigen::Vector3f::UnitZ();
    shots.push_back(next);
  }
  return shots;
}

}  // namespace

void add_ghosts(double share, const ScanSetting& setting, core::Rng& rng, CastScan& scan) {
  const ReceiverConfig& receiver = setting.unit->receiver;
  const auto far = static_cast<float>(receiver.max_range_m);
  const std::vector<Mirrored> mirrored = mirrored_beams(share, setting, rng, scan);
  if (mirrored.empty()) return;
  std::vector<Shot> shots = reflected(mirrored, *setting.caster, far);
  setting.caster->cast(shots, far);
  for (std::size_t k = 0; k < shots.size(); ++k) {
    const float range = mirrored[k].shot.distance + shots[k].distance;
    if (!shots[k].hit || range > far || range < receiver.min_range_m) continue;
    const Material& m = setting.world->materials[shots[k].material];
    const double power = m.reflectivity * shots[k].cosine / (range * range);
    if (!rng.chance(1 - std::exp(-power / receiver.sensitivity))) continue;
    const std::size_t i = mirrored[k].beam;
    scan.range_m[i] = range;
    scan.points[i] = setting.unit->beams.origins[i] + range * setting.unit->beams.directions[i];
    scan.reflectivity[i] = 0.5F * m.reflectivity;
    scan.labels[i] = kOutlier;
    scan.objects[i] = 0;
  }
}

}  // namespace saker::simulation
