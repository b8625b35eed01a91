#include "saker/autonomy/config.h"

#include <algorithm>

namespace saker::autonomy {
namespace {

constexpr double kUnderFence = 0.4;  // m: a take-off swings over its height
constexpr double kSteepestDeg = 89;  // of a beam: at 90 it has no direction on the ground

void set_prior(active::PamsConfig& pams, const objects::ObjectClass& target) {
  if (!pams.prior_of_class) return;
  pams.prior_length_m = target.length_sd_m;
  pams.prior_width_m = target.width_sd_m;
}

}  // namespace

active::ActiveConfig active_as_flown(const Config& config, const lidar::SensorInfo& sensor) {
  active::ActiveConfig active = config.active;
  active.view.R_body_lidar = lidar::mount_pose(config.mount).linear();
  if (!sensor.beam_altitude_deg.empty()) {
    const auto [lowest, highest] = std::ranges::minmax(sensor.beam_altitude_deg);
    active.view.lowest_deg = std::max(lowest, -kSteepestDeg);
    active.view.highest_deg = std::min(highest, kSteepestDeg);
  }
  const objects::ObjectClass& target = config.objects[config.objects.first_target()];
  set_prior(active.paper, target);
  set_prior(active.saker, target);
  return active;
}

std::string noise_note(const Config& config, const std::string& sensor) {
  if (config.slam.measurement_noise == slam::NoiseSource::fixed) return {};
  return sensor_note(load_uncertainty(config.uncertainty, config.objects)->provenance(), sensor);
}

Config within_geofence(Config config) {
  const double highest = config.motion.geofence.highest_m - kUnderFence;
  config.mission.height_m = std::min(config.mission.height_m, highest);
  config.active.viewpoints.height_m = std::min(config.active.viewpoints.height_m, highest);
  return config;
}

}  // namespace saker::autonomy
