#include "saker/simulation/mission/spiral_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace saker::simulation {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kSoftening = 1.5;  ///< m: turns at 1 rad/s at most at 2.5 m/s

}  // namespace

SpiralPath::SpiralPath(const SpiralConfig& config, const SE3& T_sim_object,
                       const Eigen::Vector2d& half_size, core::Rng& rng)
    : config_(config), T_sim_object_(T_sim_object), half_size_(half_size) {
  const double mean_half = 0.5 * half_size.sum();
  first_gap_ = config.nearest_m + config.start_spread_m * std::pow(rng.uniform(), 2);
  last_gap_ = config.farthest_m - mean_half;
  if (rng.chance(0.5)) std::swap(first_gap_, last_gap_);
  speed_ = rng.uniform(config.slowest_mps, config.fastest_mps);
  way_ = rng.chance(0.5) ? 1 : -1;
  first_bearing_ = rng.uniform(-kPi, kPi);
  softening_ = mean_half + kSoftening;
  middle_height_ = rng.uniform(0.2, 0.8);
  const double most = std::min(middle_height_, 1 - middle_height_);
  rise_ = random_swing(most * rng.uniform(0.5, 1), 18, 36, rng);
  look_ = random_swing(config.look_around_deg * kPi / 180, 9, 15, rng);
  roll_ = random_swing(config.vibration_deg * kPi / 180, 0.08, 0.12, rng);
  pitch_ = random_swing(config.vibration_deg * kPi / 180, 0.08, 0.12, rng);
}

double SpiralPath::gap(double t) const {
  const double share =
      cruised_s(t, config_.duration_s) / cruised_s(config_.duration_s, config_.duration_s);
  return first_gap_ + share * (last_gap_ - first_gap_);
}

/// Turns at speed / (gap + softening): the integral of that over a gap that grows evenly.
double SpiralPath::bearing(double t) const {
  const double rate = (last_gap_ - first_gap_) / cruised_s(config_.duration_s, config_.duration_s);
  const double turned = speed_ / rate * std::log((gap(t) + softening_) / (first_gap_ + softening_));
  return first_bearing_ + way_ * turned;
}

double SpiralPath::highest_at(double range) const {
  const double rise = 1 - std::exp(-range / config_.rise_m);
  return config_.lowest_m + rise * (config_.highest_m - config_.lowest_m);
}

Eigen::Vector3d SpiralPath::position(double t) const {
  const double at = bearing(t);
  const Eigen::Vector2d axes = half_size_.array() + gap(t);
  const Eigen::Vector2d p(axes.x() * std::cos(at), axes.y() * std::sin(at));
  const double share = middle_height_ + rise_.at(cruised_s(t, config_.duration_s));
  const double height = config_.lowest_m + share * (highest_at(p.norm()) - config_.lowest_m);
  return T_sim_object_ * Eigen::Vector3d(p.x(), p.y(), height);
}

SE3 SpiralPath::pose(double t) const {
  const double ahead = bearing(t) + way_ * kPi / 2;  // along the spiral, roughly
  const double heading =
      core::yaw(T_sim_object_.linear()) + ahead + look_.at(cruised_s(t, config_.duration_s));
  SE3 T = leaning_pose([this](double when) { return position(when); }, heading, t);
  T.linear() = T.linear() * core::so3_exp({roll_.at(t), pitch_.at(t), 0});
  return T;
}

}  // namespace saker::simulation
