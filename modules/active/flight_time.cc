#include "active/flight_time.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace saker::active {
namespace {

constexpr double kRadians = std::numbers::pi / 180;

/// \param speed at the start, negative: away; what cannot be braked before the end is flown back.
double to_rest(double way, double speed, double most, double acceleration) {
  const double braking = 0.5 * speed * speed / acceleration;
  if (speed > 0 && braking > way) {
    return speed / acceleration + to_rest(braking - way, 0, most, acceleration);
  }
  const double peak = std::sqrt(way * acceleration + 0.5 * speed * speed);
  const double ramps = (2 * std::min(peak, most) - speed) / acceleration;
  const double ramps_m = (most * most - 0.5 * speed * speed) / acceleration;
  return peak <= most ? ramps : ramps + (way - ramps_m) / most;
}

}  // namespace

double flight_time_s(const Eigen::Vector3d& way, double turn, const motion::LimitsConfig& limits,
                     const Eigen::Vector3d& velocity) {
  const double fast = limits.max_speed, acceleration = limits.max_acceleration;
  const Eigen::Vector3d ahead = way.stableNormalized();
  const double speed = std::min(velocity.dot(ahead), fast);
  const double across = (velocity - velocity.dot(ahead) * ahead).norm();
  const double along = to_rest(way.norm(), speed, fast, acceleration);
  const double aside = to_rest(0, across, fast, acceleration);
  const double climb = to_rest(std::abs(way.z()), 0, limits.max_climb_speed, acceleration);
  const double turning =
      to_rest(std::abs(std::remainder(turn, 2 * std::numbers::pi)), 0,
              limits.max_yaw_rate_deg * kRadians, limits.max_yaw_acceleration_deg * kRadians);
  return std::max({along, aside, climb, turning}) + limits.smoothing_s();
}

}  // namespace saker::active
