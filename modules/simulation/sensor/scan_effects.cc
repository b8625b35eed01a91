#include "saker/simulation/sensor/scan_effects.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "saker/simulation/sensor/ghosts.h"

namespace saker::simulation {
namespace {

constexpr double kPi = std::numbers::pi;

/// A return of a beam at another range.
void place_return(const BeamTable& beams, std::size_t i, double range, CastScan& scan) {
  scan.range_m[i] = static_cast<float>(range);
  scan.points[i] = beams.origins[i] + scan.range_m[i] * beams.directions[i];
}

void place_outlier(const BeamTable& beams, std::size_t i, double range, double reflectivity,
                   CastScan& scan) {
  place_return(beams, i, range, scan);
  scan.reflectivity[i] = static_cast<float>(reflectivity);
  scan.labels[i] = kOutlier;
  scan.objects[i] = 0;
}

bool behind(const CastScan& scan, std::size_t i, double range) {
  return scan.range_m[i] <= 0 || scan.range_m[i] > range;
}

/// The carrier hides what is behind it; its own returns are in the file or not.
void hide_by_body(const ScanEffects& effects, const ScanSetting& setting, core::Rng& rng,
                  CastScan& scan) {
  if (setting.mount->body.empty()) return;
  const SE3& T = setting.mount->T_vehicle_lidar;
  const ReceiverConfig& receiver = setting.unit->receiver;
  const BeamTable& beams = setting.unit->beams;
  const bool shown = effects.own_return_share > 0;
  for (std::size_t i = 0; i < scan.range_m.size(); ++i) {
    const double range = distance_to_body(setting.mount->body, T * beams.origins[i].cast<double>(),
                                          T.linear() * beams.directions[i].cast<double>());
    if (!behind(scan, i, range)) continue;
    if (!std::isfinite(range)) continue;
    scan.range_m[i] = 0;
    if (!shown || range < receiver.min_range_m || !rng.chance(effects.own_return_share)) continue;
    place_outlier(beams, i, range + rng.normal(0, receiver.noise_m), rng.uniform(0.02, 0.3), scan);
    scan.labels[i] = kUnlabelled;
  }
}

void block_sectors(const std::vector<BlockedSector>& blocked, const BeamTable& beams,
                   CastScan& scan) {
  for (const BlockedSector& sector : blocked) {
    for (int row = static_cast<int>(sector.first_row * scan.rows); row < scan.rows; ++row) {
      for (int column = 0; column < scan.columns; ++column) {
        const std::size_t i = beams.index(row, column);
        const double azimuth = std::atan2(beams.directions[i].y(), beams.directions[i].x());
        if (std::abs(std::remainder(azimuth - sector.azimuth, 2 * kPi)) < sector.half_width)
          scan.range_m[i] = 0;
      }
    }
  }
}

/// Drops and flakes near the sensor, and light that does not come back through them.
void rain(const ScanEffects& effects, const SensorUnit& unit, core::Rng& rng, CastScan& scan) {
  if (effects.near_share <= 0 && effects.extinction_per_m <= 0) return;
  for (std::size_t i = 0; i < scan.range_m.size(); ++i) {
    const double lost = 1 - std::exp(-2 * effects.extinction_per_m * scan.range_m[i]);
    if (scan.range_m[i] > 0 && rng.chance(lost)) scan.range_m[i] = 0;
    if (!rng.chance(effects.near_share)) continue;
    const double range =
        unit.receiver.min_range_m - effects.near_range_m * std::log(1 - rng.uniform());
    if (behind(scan, i, range)) place_outlier(unit.beams, i, range, rng.uniform(0, 0.06), scan);
  }
}

/// Where a beam enters and leaves a puff, along it.
std::pair<float, float> chord(const Puff& puff, const Eigen::Vector3f& origin,
                              const Eigen::Vector3f& direction) {
  const Eigen::Vector3f to = puff.centre - origin;
  const float middle = to.dot(direction);
  const float half = puff.radius_m * puff.radius_m - (to.squaredNorm() - middle * middle);
  if (half <= 0) return {0, 0};
  return {std::max(0.0F, middle - std::sqrt(half)), std::max(0.0F, middle + std::sqrt(half))};
}

void spray(const std::vector<Puff>& puffs, const ScanSetting& setting, core::Rng& rng,
           CastScan& scan) {
  if (puffs.empty()) return;
  const BeamTable& beams = setting.unit->beams;
  for (int column = 0; column < scan.columns; ++column) {
    const Eigen::Isometry3f T = setting.T_world_lidar(column).cast<float>();
    for (int row = 0; row < scan.rows; ++row) {
      const std::size_t i = beams.index(row, column);
      for (const Puff& puff : puffs) {
        const auto [enter, leave] =
            chord(puff, T * beams.origins[i], T.linear() * beams.directions[i]);
        if (leave <= enter || !behind(scan, i, enter)) continue;
        const double range = enter - std::log(1 - rng.uniform()) / puff.density_per_m;
        if (range < leave && range > setting.unit->receiver.min_range_m && behind(scan, i, range))
          place_outlier(beams, i, range, rng.uniform(0, 0.1), scan);
      }
    }
  }
}

void crosstalk(const ScanEffects& effects, const SensorUnit& unit, core::Rng& rng, CastScan& scan) {
  if (effects.crosstalk_share <= 0) return;
  const ReceiverConfig& receiver = unit.receiver;
  const double returns = effects.crosstalk_share * static_cast<double>(scan.range_m.size());
  for (int k = 0; k < static_cast<int>(returns); ++k) {
    const auto i = static_cast<std::size_t>(rng.index(static_cast<int>(scan.range_m.size())));
    place_outlier(unit.beams, i, rng.uniform(receiver.min_range_m, receiver.max_range_m),
                  rng.uniform(0, 0.2), scan);
  }
}

void lose_packets(const ScanEffects& effects, core::Rng& rng, CastScan& scan) {
  for (int k = 0; k < effects.lost_packets; ++k) {
    const int first = rng.index(scan.columns);
    for (int c = first; c < std::min(scan.columns, first + effects.packet_columns); ++c) {
      for (int row = 0; row < scan.rows; ++row)
        scan.range_m[static_cast<std::size_t>(row) * scan.columns + c] = 0;
    }
  }
}

void round_ranges(const ScanEffects& effects, const SensorUnit& unit, CastScan& scan) {
  for (std::size_t i = 0; i < scan.range_m.size(); ++i) {
    if (scan.range_m[i] <= 0) continue;
    if (effects.range_cut_m > 0 && scan.range_m[i] > effects.range_cut_m) scan.range_m[i] = 0;
    if (effects.range_step_m <= 0 || scan.range_m[i] <= 0) continue;
    place_return(
        unit.beams, i,
        std::max(1.0, std::round(scan.range_m[i] / effects.range_step_m)) * effects.range_step_m,
        scan);
  }
}

void add_puffs(const Mount& mount, core::Rng& rng, std::vector<Puff>& puffs) {
  const int places = 1 + rng.index(3);
  for (int k = 0; k < places; ++k) {
    const Eigen::Vector3d at(rng.uniform(-25, 25), rng.uniform(-8, 8), rng.uniform(0.2, 0.8));
    const double density = 0.02 * std::exp(rng.uniform(0, 3));
    for (int lump = 0; lump < 5; ++lump) {
      const Eigen::Vector3d off(rng.normal(0, 1.2), rng.normal(0, 0.5),
                                std::abs(rng.normal(0, 0.3)));
      puffs.push_back({(mount.T_world_vehicle * Eigen::Vector3d(at + off)).cast<float>(),
                       static_cast<float>(rng.uniform(0.3, 1.1)), static_cast<float>(density)});
    }
  }
}

BlockedSector any_sector(core::Rng& rng) {
  return {rng.uniform(-kPi, kPi), rng.uniform(0.02, rng.chance(0.3) ? 1.0 : 0.25),
          rng.chance(0.5) ? 0 : rng.uniform(0.3, 0.8)};
}

}  // namespace

ScanEffects any_weather(const Mount& mount, core::Rng& rng) {
  ScanEffects effects;
  const double kind = rng.uniform();
  const double strength = rng.uniform();
  if (kind < 0.08) {  // rain or snow
    effects.near_share = 0.0005 * std::exp(4 * strength);
    effects.near_range_m = rng.uniform(1.5, 6);
    effects.extinction_per_m = 0.0005 + 0.003 * strength;
  } else if (kind < 0.11) {  // fog
    effects.near_share = 0.005 * std::exp(3 * strength);
    effects.near_range_m = rng.uniform(1, 4);
    effects.extinction_per_m = 0.003 + 0.015 * strength;
  }
  if (kind < 0.06 || (kind > 0.11 && kind < 0.15)) add_puffs(mount, rng, effects.puffs);
  return effects;
}

void add_sensor_effects(const SensorUnit& unit, ScanEffects& effects, core::Rng& rng) {
  effects.range_step_m = rng.chance(0.7) ? unit.range_step_m : rng.uniform(0.005, 0.02);
  if (rng.chance(0.5)) effects.crosstalk_share = 1e-5 * std::exp(rng.uniform(0, 4));
  if (rng.chance(0.4)) effects.ghost_share = rng.uniform(0.05, 0.5);
  if (rng.chance(0.15)) effects.echo_share = rng.uniform(0.3, 0.9);
  if (rng.chance(0.2)) effects.range_cut_m = rng.uniform(30, 100);
  if (rng.chance(0.15)) effects.lost_packets = 1 + rng.index(12);
  effects.packet_columns = rng.chance(0.5) ? 16 : 2 + rng.index(30);
  if (rng.chance(0.3)) effects.own_return_share = rng.uniform(0.5, 1);
  const int sectors = rng.chance(0.3) ? 1 + rng.index(4) : 0;
  for (int k = 0; k < sectors; ++k) effects.blocked.push_back(any_sector(rng));
}

void wet_ground(World& world, double wetness) {
  if (wetness <= 0) return;
  for (Material& m : world.materials) {
    const bool paved = m.label == kRoad || m.label == kParking || m.label == kSidewalk ||
                       m.label == kLaneMarking || m.label == kOtherGround;
    if (!paved) continue;
    m.reflectivity *= static_cast<float>(1 - 0.6 * wetness);
    m.gloss = std::max(m.gloss, static_cast<float>(0.5 + 0.45 * wetness));
  }
}

void apply_effects(const ScanEffects& effects, const ScanSetting& setting, core::Rng& rng,
                   CastScan& scan) {
  const SensorUnit& unit = *setting.unit;
  if (effects.ghost_share > 0) add_ghosts(effects.ghost_share, setting, rng, scan);
  hide_by_body(effects, setting, rng, scan);
  block_sectors(effects.blocked, unit.beams, scan);
  rain(effects, unit, rng, scan);
  spray(effects.puffs, setting, rng, scan);
  crosstalk(effects, unit, rng, scan);
  lose_packets(effects, rng, scan);
  round_ranges(effects, unit, scan);
}

}  // namespace saker::simulation
