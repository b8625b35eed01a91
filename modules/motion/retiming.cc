#include "saker/motion/retiming.h"

#include <algorithm>
#include <cmath>

#include "saker/motion/yaw.h"

namespace saker::motion {
namespace {

constexpr int kFine = 10;  // steps of the averaged motion in one of the trajectory: 5 ms

/// The window in fine steps.
struct Window {
  explicit Window(const LimitsConfig& limits)
      : step_s(limits.step_s / kFine),
        half(std::max(1, static_cast<int>(std::ceil(0.5 * limits.smoothing_s() / step_s)))) {}

  [[nodiscard]] double half_s() const { return half * step_s; }

  double step_s;
  int half;
};

/// Constant acceleration, shifted so that its mean over the window around t = 0 is the start.
Eigen::Vector3d in_first_window(const MotionState& start, const Window& window, double t) {
  // Mean of t² over the window by the trapezoid rule, which is how it will be taken.
  const double width_s = 2 * window.half_s();
  const double mean_t2 = width_s * width_s / 12 + window.step_s * window.step_s / 6;
  return start.position + t * start.velocity + 0.5 * (t * t - mean_t2) * start.acceleration;
}

/// A curve flown at its speeds: constant acceleration between two points.
class Flight {
 public:
  Flight(const Curve& curve, const std::vector<double>& speeds) : curve_(curve), speeds_(speeds) {
    times_.push_back(0);
    for (std::size_t i = 1; i < curve.size(); ++i)
      times_.push_back(times_.back() +
                       2 * (curve[i].s - curve[i - 1].s) / (speeds[i - 1] + speeds[i]));
  }

  [[nodiscard]] double duration_s() const { return times_.back(); }

  [[nodiscard]] Eigen::Vector3d position(double t) const {
    if (t >= duration_s()) return curve_.back().position;
    const auto after = std::upper_bound(times_.begin(), times_.end(), t) - times_.begin();
    const auto i = static_cast<std::size_t>(after) - 1;
    const double interval = times_[i + 1] - times_[i];
    const double dt = t - times_[i];
    const double s = dt * (speeds_[i] + 0.5 * (speeds_[i + 1] - speeds_[i]) / interval * dt);
    return on_arc(curve_[i], curve_[i + 1], s);
  }

 private:
  /// Cubic Hermite by arc length: its error on an arc is far below what central differences see.
  static Eigen::Vector3d on_arc(const CurvePoint& a, const CurvePoint& b, double s) {
    const double length = b.s - a.s;
    const double u = s / length, u2 = u * u, u3 = u2 * u;
    return a.position + (3 * u2 - 2 * u3) * (b.position - a.position) +
           length * ((u3 - 2 * u2 + u) * a.leaving + (u3 - u2) * b.arriving);
  }

  const Curve& curve_;
  const std::vector<double>& speeds_;
  std::vector<double> times_;  // s
};

/// Positions every fine step from half a window (and a step) before the start to one after rest.
std::vector<Eigen::Vector3d> motion_to_average(const MotionState& start, const Flight& flight,
                                               const Window& window) {
  const int rest = window.half + static_cast<int>(std::ceil(flight.duration_s() / window.step_s));
  std::vector<Eigen::Vector3d> positions;
  for (int k = -window.half - 1; k <= rest + 2 * window.half + kFine + 1; ++k) {
    positions.push_back(k < window.half ? in_first_window(start, window, k * window.step_s)
                                        : flight.position((k - window.half) * window.step_s));
  }
  return positions;
}

/// Means over the window: states every fine step, without yaw.
std::vector<MotionState> averaged(const std::vector<Eigen::Vector3d>& positions,
                                  const Window& window) {
  const std::size_t width = 2 * static_cast<std::size_t>(window.half);
  const double width_s = 2 * window.half_s();
  const auto velocity = [&](std::size_t k) -> Eigen::Vector3d {
    return (positions[k + 1] - positions[k - 1]) / (2 * window.step_s);
  };
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t k = 1; k <= width; ++k) sum += 0.5 * (positions[k] + positions[k + 1]);
  std::vector<MotionState> states;
  for (std::size_t k = 1; k + width + 1 < positions.size(); ++k) {
    MotionState state;
    state.position = sum / static_cast<double>(width);
    state.velocity = (positions[k + width] - positions[k]) / width_s;
    state.acceleration = (velocity(k + width) - velocity(k)) / width_s;
    states.push_back(state);
    sum +=
        0.5 * (positions[k + width] + positions[k + width + 1] - positions[k] - positions[k + 1]);
  }
  return states;
}

}  // namespace

MotionState after_first_window(const MotionState& start, const LimitsConfig& limits) {
  const Window window(limits);
  MotionState state = start;
  state.position = in_first_window(start, window, window.half_s());
  state.velocity = start.velocity + window.half_s() * start.acceleration;
  return state;
}

Trajectory retimed(const MotionState& start, Time start_time, const Curve& curve,
                   const std::vector<double>& speeds, std::optional<double> goal_yaw,
                   const LimitsConfig& limits) {
  const Window window(limits);
  const std::vector<MotionState> motion =
      averaged(motion_to_average(start, Flight(curve, speeds), window), window);
  std::vector<Eigen::Vector3d> velocities;
  for (const MotionState& state : motion) velocities.push_back(state.velocity);
  const std::vector<YawState> yaws =
      yaw_along(velocities, window.step_s, {start.yaw, start.yaw_rate}, goal_yaw, limits);

  Trajectory trajectory;
  trajectory.start = start_time;
  trajectory.step_s = limits.step_s;
  for (std::size_t k = 0; k < yaws.size() + kFine - 1; k += kFine) {
    MotionState state = motion[std::min(k, motion.size() - 1)];
    const YawState& yaw = yaws[std::min(k, yaws.size() - 1)];
    state.yaw = wrapped(yaw.yaw);
    state.yaw_rate = yaw.yaw_rate;
    trajectory.states.push_back(state);
  }
  trajectory.states.front() = start;  // which it is but for what the differences round
  MotionState& last = trajectory.states.back();
  last.position = curve.back().position;
  last.velocity.setZero();
  last.acceleration.setZero();
  last.yaw_rate = 0;
  return trajectory;
}

}  // namespace saker::motion
