#include "saker/motion/trajectory_check.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>

namespace saker::motion {
namespace {

constexpr double kStep_m = 0.05;
constexpr double kTolerance = 1.05;  // of a limit: finite differences at corners of the profile

std::string at_place(const char* what, const Eigen::Vector3d& p) {
  char text[120];
  std::snprintf(text, sizeof text, "%s at (%.2f, %.2f, %.2f)", what, p.x(), p.y(), p.z());
  return text;
}

const char* beyond_limits(const MotionState& state, const MotionState& first,
                          const LimitsConfig& limits) {
  const auto beyond = [](double value, double limit, double at_start) {
    return !(value <= kTolerance * std::max(limit, at_start) + 1e-6);
  };
  const double most_yaw_rate = limits.max_yaw_rate_deg * std::numbers::pi / 180;
  if (!state.position.allFinite() || !std::isfinite(state.yaw)) return "not finite";
  if (beyond(state.velocity.norm(), limits.max_speed, first.velocity.norm())) return "too fast";
  if (beyond(std::abs(state.velocity.z()), limits.max_climb_speed, std::abs(first.velocity.z())))
    return "climbs too fast";
  if (beyond(state.acceleration.norm(), limits.max_acceleration, first.acceleration.norm()))
    return "accelerates too hard";
  if (beyond(std::abs(state.yaw_rate), most_yaw_rate, std::abs(first.yaw_rate)))
    return "turns too fast";
  return nullptr;
}

}  // namespace

TrajectoryCheck examined(const Trajectory& trajectory, const FreeSpace& space,
                         const LimitsConfig& limits) {
  TrajectoryCheck check;
  if (trajectory.empty()) return {"no states", NAN};
  for (const MotionState& state : trajectory.states) {
    if (const char* what = beyond_limits(state, trajectory.states.front(), limits))
      return {at_place(what, state.position), NAN};
  }
  check.clearance_m = std::numeric_limits<double>::infinity();
  const Time step = std::max<Time>(1, from_seconds(kStep_m / (kTolerance * limits.max_speed)));
  for (Time time = trajectory.start; time < trajectory.end() + step; time += step) {
    const Eigen::Vector3d p = trajectory.sample(time).position;
    check.clearance_m = std::min(check.clearance_m, space.clearance_m(p));
    if (!space.safe(p)) return {at_place("too near to what is not free", p), check.clearance_m};
  }
  const MotionState& last = trajectory.states.back();
  const bool rests = last.velocity.isZero() && last.acceleration.isZero() && last.yaw_rate == 0;
  if (!rests) check.fault = at_place("not at rest", last.position);
  return check;
}

}  // namespace saker::motion
