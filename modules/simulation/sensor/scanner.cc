#include "saker/simulation/sensor/scanner.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace saker::simulation {
namespace {

constexpr int kMostSurfaces = 6;  ///< that a beam may pass

/// Two independent normal numbers for little more than the cost of one: Box–Muller's both, in the
/// precision that millimetres need.
std::pair<float, float> two_normals(core::Rng& rng) {
  const float radius = std::sqrt(-2 * std::log(static_cast<float>(1 - rng.uniform())));
  const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(rng.uniform());
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

/// Share of the light that comes back from where it met the surface, of the diffuse one.
double returned_share(const Material& m, double cosine, double diffuse) {
  if (m.gloss == 0) return diffuse;
  const double highlight = m.gloss * 2.5 * std::exp(-(1 - cosine) / 0.02);
  return (1 - m.gloss) * diffuse + highlight;
}

/// Chance that a surface sends the pulse elsewhere: glass nearly always, dark polished paint at
/// grazing angles.
double mirrored_away(const Material& m, double cosine) {
  if (m.gloss == 0) return 0;
  const double grazing = 1 - cosine;
  return std::min(1.0, std::pow(m.gloss, 6) * (0.1 + grazing) + std::pow(m.gloss, 60));
}

}  // namespace

ReceiverConfig hdl64_receiver() {
  ReceiverConfig config;
  config.min_range_m = 1.3;
  config.max_range_m = 80;
  config.noise_m = 0.013;
  config.noise_per_m = 0.0001;
  config.beam_bias_m = 0.012;
  config.divergence_mrad = 0.7;
  config.mixed_share = 0.2;
  config.drop_share = 0.01;
  return config;
}

Scanner::Scanner(const RayCaster& caster, const World& world, BeamTable beams,
                 const ReceiverConfig& config, std::uint64_t seed)
    : caster_(&caster),
      world_(&world),
      beams_(std::move(beams)),
      config_(core::checked(config, "receiver")),
      rng_(seed) {
  core::Rng rng = rng_.fork(0);
  for (int row = 0; row < beams_.rows; ++row) {
    beam_bias_.push_back(static_cast<float>(rng.normal(0, config_.beam_bias_m)));
  }
}

void Scanner::aim(int column, const SE3& T_world_lidar, core::Rng& rng,
                  std::vector<Shot>& shots) const {
  const Eigen::Isometry3f T = T_world_lidar.cast<float>();
  const auto spread = static_cast<float>(1e-3 * config_.divergence_mrad);
  for (int row = 0; row < beams_.rows; ++row) {
    const std::size_t i = beams_.index(row, column);
    const auto [across, along] = two_normals(rng);
    const Eigen::Vector3f& beam = beams_.directions[i];
    const Eigen::Vector3f aside = beam.unitOrthogonal();
    const Eigen::Vector3f jitter = spread * across * aside + spread * along * beam.cross(aside);
    Shot shot;
    shot.origin = T * beams_.origins[i];
    shot.direction = T.linear() * (beam + jitter).normalized();
    shots.push_back(shot);
  }
}

void Scanner::trace(Job& job, core::Rng& rng) const {
  const float far = static_cast<float>(config_.max_range_m) + 1;
  caster_->cast(job.shots, far);
  job.which.clear();
  for (std::size_t i = 0; i < job.shots.size(); ++i) job.which.push_back(i);
  for (int surface = 0; surface < kMostSurfaces; ++surface) {
    std::vector<std::size_t> passing;
    job.again.clear();
    for (const std::size_t i : job.which) {
      Shot& shot = job.shots[i];
      if (!shot.hit) continue;
      const float transmission = world_->materials[shot.material].transmission;
      if (transmission <= 0 || !rng.chance(transmission)) continue;
      shot.near = shot.distance + 0.002F;
      passing.push_back(i);
      job.again.push_back(shot);
    }
    if (passing.empty()) return;
    caster_->cast(job.again, far);
    for (std::size_t k = 0; k < passing.size(); ++k) job.shots[passing[k]] = job.again[k];
    job.which = std::move(passing);
  }
}

void Scanner::mix_edges(Job& job, core::Rng& rng) const {
  constexpr float kGap = 1.2F;  ///< m: pulses farther apart are told apart
  for (std::size_t i = beams_.rows; i + beams_.rows < job.shots.size(); ++i) {
    Shot& shot = job.shots[i];
    const Shot& next = job.shots[i + beams_.rows];
    if (!shot.hit || !next.hit) continue;
    const float step = next.distance - shot.distance;
    if (std::abs(step) < 0.1F || std::abs(step) > kGap || !rng.chance(config_.mixed_share))
      continue;
    shot.distance += step * static_cast<float>(rng.uniform(0.2, 0.8));
  }
}

void Scanner::receive(const Shot& shot, int row, int column, core::Rng& rng, CastScan& scan) const {
  if (!shot.hit || rng.chance(config_.drop_share)) return;
  const Material& m = world_->materials[shot.material];
  const double cosine = std::max(0.01, static_cast<double>(shot.cosine));
  const double diffuse = std::pow(static_cast<float>(cosine), 0.7F);
  const double share = returned_share(m, cosine, diffuse);
  const double reflectivity = std::clamp(m.reflectivity + rng.normal(0, m.spread), 0.005, 1.0);
  if (rng.chance(mirrored_away(m, cosine))) return;
  const double power = reflectivity * share / (shot.distance * shot.distance);
  if (!rng.chance(1 - std::exp(-power / config_.sensitivity))) return;

  const auto [depth, noise] = two_normals(rng);
  const double before = std::min(0.7, m.depth * std::abs(depth) / std::max(cosine, 0.05));
  const double sd = config_.noise_m + config_.noise_per_m * shot.distance;
  const double range = shot.distance - before + beam_bias_[row] + sd * noise;
  if (!(range >= config_.min_range_m && range <= config_.max_range_m)) return;

  const std::size_t i = beams_.index(row, column);
  scan.range_m[i] = static_cast<float>(range);
  scan.points[i] = beams_.origins[i] + static_cast<float>(range) * beams_.directions[i];
  const double seen = reflectivity * std::min(1.0, share / diffuse);
  scan.reflectivity[i] = static_cast<float>(std::round(100 * std::clamp(seen, 0.0, 0.99)) / 100);
  scan.labels[i] = m.label;
  scan.objects[i] = shot.object;
}

CastScan Scanner::empty_scan() const {
  CastScan scan;
  scan.rows = beams_.rows;
  scan.columns = beams_.columns;
  const std::size_t size = beams_.directions.size();
  scan.range_m.assign(size, 0);
  scan.points.assign(size, Eigen::Vector3f::Constant(NAN));
  scan.reflectivity.assign(size, 0);
  scan.labels.assign(size, 0);
  scan.objects.assign(size, 0);
  return scan;
}

core::Rng Scanner::rng_of(std::uint64_t scan_index) const { return rng_.fork(scan_index + 1); }

void Scanner::cast_block(int first_column, const PoseOfColumn& T_world_lidar, core::Rng& rng,
                         CastScan& scan) const {
  const int end = std::min(first_column + kColumnsAtOnce, beams_.columns);
  Job job;
  for (int column = first_column; column < end; ++column)
    aim(column, T_world_lidar(column), rng, job.shots);
  trace(job, rng);
  mix_edges(job, rng);
  std::size_t k = 0;
  for (int column = first_column; column < end; ++column) {
    for (int row = 0; row < beams_.rows; ++row) receive(job.shots[k++], row, column, rng, scan);
  }
}

CastScan Scanner::cast(const PoseOfColumn& T_world_lidar, std::uint64_t scan_index,
                       const BeforeColumn& before) const {
  core::Rng rng = rng_of(scan_index);
  CastScan scan = empty_scan();
  for (int first = 0; first < beams_.columns; first += kColumnsAtOnce) {
    if (before) before(first);
    cast_block(first, T_world_lidar, rng, scan);
  }
  return scan;
}

}  // namespace saker::simulation
