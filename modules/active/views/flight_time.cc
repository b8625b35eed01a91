#include "saker/active/views/flight_time.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace saker::active {
namespace {

constexpr double kRadians = std::numbers::pi / 180;

double rest_to_rest(double way, double speed, double acceleration) {
  const bool reaches_speed = way * acceleration >= speed * speed;
  return reaches_speed ? way / speed + speed / acceleration : 2 * std::sqrt(way / acceleration);
}

}  // namespace

double flight_time_s(const Eigen::Vector3d& way, double turn, const motion::LimitsConfig& limits) {
  const double along = rest_to_rest(way.norm(), limits.max_speed, limits.max_acceleration);
  const double climb =
      rest_to_rest(std::abs(way.z()), limits.max_climb_speed, limits.max_acceleration);
  const double turning =
      rest_to_rest(std::abs(std::remainder(turn, 2 * std::numbers::pi)),
                   limits.max_yaw_rate_deg * kRadians, limits.max_yaw_acceleration_deg * kRadians);
  return std::max({along, climb, turning}) + limits.smoothing_s();
}

}  // namespace saker::active
