#include "saker/simulation/mission/flight_path.h"

#include <numbers>

namespace saker::simulation {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

}  // namespace

FlightPath::FlightPath(const FlightConfig& config, const Terrain& terrain, core::Rng& rng)
    : config_(config), terrain_(&terrain) {
  sway_ = random_swing(config.sway_m, 11, 17, rng);
  rise_ = random_swing(config.height_swing_m, 12, 20, rng);
  look_ = random_swing(config.look_around_deg * kDegree, 9, 15, rng);
  roll_ = random_swing(config.vibration_deg * kDegree, 0.08, 0.12, rng);
  pitch_ = random_swing(config.vibration_deg * kDegree, 0.08, 0.12, rng);
  start_s_ = -travelled(config.duration_s) / 2;
  base_z_ = terrain.height(start_s_, 0) - terrain.shape().grade * start_s_;
}

double FlightPath::travelled(double t) const {
  return config_.speed_mps * cruised_s(t, config_.duration_s);
}

double FlightPath::envelope(double t) const { return smooth_step((t - kHover) / 4); }

Eigen::Vector3d FlightPath::position(double t) const {
  const double s = start_s_ + travelled(t);
  Eigen::Vector3d p = terrain_->point(s, envelope(t) * sway_.at(t));
  p.z() = base_z_ + terrain_->shape().grade * s + config_.height_m + envelope(t) * rise_.at(t);
  return p;
}

double FlightPath::heading(double t) const {
  return terrain_->heading(start_s_ + travelled(t)) + envelope(t) * look_.at(t);
}

SE3 FlightPath::pose(double t) const {
  SE3 T = leaning_pose([this](double at) { return position(at); }, heading(t), t);
  T.linear() = T.linear() * core::so3_exp({roll_.at(t), pitch_.at(t), 0});
  return T;
}

}  // namespace saker::simulation
