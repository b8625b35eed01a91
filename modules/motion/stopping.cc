#include "motion/stopping.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace saker::motion {
namespace {

constexpr double kLongestStop_s = 120;  // a state that takes longer is no state of this vehicle

/// Acceleration `from`, by a ramp to `hold`, which stays, and by a ramp to zero, in closed form.
class Trapezoid {
 public:
  Trapezoid(const MotionState& start, double ramp_s, double max_acceleration)
      : start_(start), ramp_s_(ramp_s) {
    // The two ramps alone take this from the velocity; what is left decides how long `hold` stays.
    const Eigen::Vector3d to_lose = start.velocity + 0.5 * ramp_s * start.acceleration;
    hold_s_ = std::max(0.0, to_lose.norm() / max_acceleration - ramp_s);
    hold_ = -to_lose / (ramp_s + hold_s_);
    ramped_in_ = ramp(start, hold_, ramp_s_);
    held_ = ramp(ramped_in_, hold_, hold_s_);
  }

  [[nodiscard]] double duration_s() const { return 2 * ramp_s_ + hold_s_; }

  [[nodiscard]] MotionState at(double t) const {
    if (t < ramp_s_) return ramp(start_, between(start_.acceleration, hold_, t / ramp_s_), t);
    t -= ramp_s_;
    if (t < hold_s_) return ramp(ramped_in_, hold_, t);
    t = std::min(t - hold_s_, ramp_s_);
    return ramp(held_, between(hold_, Eigen::Vector3d::Zero(), t / ramp_s_), t);
  }

 private:
  static Eigen::Vector3d between(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double u) {
    return a + u * (b - a);
  }
  /// After t seconds in which the acceleration runs straight to `acceleration`.
  static MotionState ramp(const MotionState& from, const Eigen::Vector3d& acceleration, double t) {
    MotionState to;
    to.acceleration = acceleration;
    to.velocity = from.velocity + 0.5 * t * (from.acceleration + acceleration);
    to.position =
        from.position + t * from.velocity + t * t / 6 * (2 * from.acceleration + acceleration);
    return to;
  }

  MotionState start_;
  double ramp_s_;
  double hold_s_ = NAN;
  Eigen::Vector3d hold_ = Eigen::Vector3d::Constant(NAN);
  MotionState ramped_in_, held_;
};

bool finite(const MotionState& s) {
  return s.position.allFinite() && s.velocity.allFinite() && s.acceleration.allFinite() &&
         std::isfinite(s.yaw) && std::isfinite(s.yaw_rate);
}

}  // namespace

Trajectory stopping_trajectory(const MotionState& state, Time time, const LimitsConfig& limits) {
  Trajectory trajectory;
  trajectory.start = time;
  trajectory.step_s = limits.step_s;
  if (!finite(state)) return trajectory;

  const Trapezoid motion(state, limits.smoothing_s(), limits.max_acceleration);
  const double yaw_acceleration = limits.max_yaw_acceleration_deg * std::numbers::pi / 180;
  const double yaw_s = std::abs(state.yaw_rate) / yaw_acceleration;
  const double duration_s = std::max(motion.duration_s(), yaw_s);
  if (duration_s > kLongestStop_s) return trajectory;
  const int steps = static_cast<int>(std::ceil(duration_s / limits.step_s));
  for (int i = 0; i <= steps; ++i) {
    const double t = i * limits.step_s;
    MotionState s = motion.at(t);
    const double turning_s = std::min(t, yaw_s);
    s.yaw_rate = state.yaw_rate - std::copysign(yaw_acceleration * turning_s, state.yaw_rate);
    s.yaw = wrapped(state.yaw + 0.5 * (state.yaw_rate + s.yaw_rate) * turning_s);
    trajectory.states.push_back(s);
  }
  trajectory.states.back().velocity.setZero();  // exactly: rounding leaves 1e-16
  trajectory.states.back().acceleration.setZero();
  trajectory.states.back().yaw_rate = 0;
  return trajectory;
}

}  // namespace saker::motion
