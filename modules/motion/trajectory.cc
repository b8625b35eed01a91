#include "saker/motion/trajectory.h"

#include <algorithm>
#include <cmath>

namespace saker::motion {
namespace {

MotionState at_rest(MotionState state) {
  state.velocity.setZero();
  state.acceleration.setZero();
  state.yaw_rate = 0;
  return state;
}

/// Cubic Hermite position, its derivative as velocity; the others straight between the two.
MotionState between(const MotionState& a, const MotionState& b, double step_s, double u) {
  const double u2 = u * u, u3 = u2 * u;
  const Eigen::Vector3d chord = b.position - a.position;
  MotionState state;
  state.position = a.position + (3 * u2 - 2 * u3) * chord +
                   step_s * ((u3 - 2 * u2 + u) * a.velocity + (u3 - u2) * b.velocity);
  state.velocity = 6 * (u - u2) / step_s * chord + (3 * u2 - 4 * u + 1) * a.velocity +
                   (3 * u2 - 2 * u) * b.velocity;
  state.acceleration = a.acceleration + u * (b.acceleration - a.acceleration);
  state.yaw = wrapped(a.yaw + u * wrapped(b.yaw - a.yaw));
  state.yaw_rate = a.yaw_rate + u * (b.yaw_rate - a.yaw_rate);
  return state;
}

}  // namespace

double wrapped(double angle) { return std::remainder(angle, 2 * M_PI); }

MotionState Trajectory::sample(Time time) const {
  if (empty()) return {};
  if (time >= end()) return at_rest(states.back());
  if (time <= start) return states.front();
  const double steps = to_seconds(time - start) / step_s;
  const auto i = std::min(static_cast<std::size_t>(steps), states.size() - 2);
  return between(states[i], states[i + 1], step_s, steps - static_cast<double>(i));
}

}  // namespace saker::motion
