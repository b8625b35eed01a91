#include "saker/simulation/vehicle/wind.h"

#include <cmath>
#include <numbers>

namespace saker::simulation {

Wind::Wind(const WindConfig& config, core::Rng rng)
    : config_(core::checked(config, "wind")), rng_(rng) {
  const double towards = config_.towards_deg * std::numbers::pi / 180;
  mean_ = config_.mean_mps * Eigen::Vector3d(std::cos(towards), std::sin(towards), 0);
}

Eigen::Vector3d Wind::step(double dt) {
  const double kept = std::exp(-dt / config_.gust_time_s);
  const double fresh = config_.gust_mps * std::sqrt(1 - kept * kept);
  const Eigen::Vector3d spread(fresh, fresh, fresh / 2);
  for (int axis = 0; axis < 3; ++axis)
    gust_[axis] = kept * gust_[axis] + rng_.normal(0, spread[axis]);
  return mean_ + gust_ + extra_;
}

}  // namespace saker::simulation
