#include "saker/motion/yaw.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "saker/motion/trajectory.h"

namespace saker::motion {
namespace {

constexpr double kHasHeading = 0.3;  // m/s, level: slower, the direction of travel says nothing
constexpr double kSettled = 1e-9;    // rad

/// Yaw before it is averaged: straight on through the first window, then by steps within the rate.
class Turning {
 public:
  Turning(const YawState& start, int half_window, double step_s, double most_rate)
      : half_window_(half_window), most_step_(most_rate * step_s) {
    for (int k = -half_window; k <= half_window; ++k)
      raw_.push_back(start.yaw + k * step_s * start.yaw_rate);
  }

  void follow(const std::vector<Eigen::Vector3d>& velocities, std::optional<double> goal_yaw) {
    const int count = static_cast<int>(velocities.size());
    for (int k = half_window_ + 1; k < count; ++k) {
      const double left = (count - k) * most_step_;
      if (goal_yaw && std::abs(to(*goal_yaw)) >= left) break;
      const Eigen::Vector2d velocity = velocities[static_cast<std::size_t>(k)].head<2>();
      const bool moves = velocity.norm() > kHasHeading;
      step(moves ? to(std::atan2(velocity.y(), velocity.x())) : 0);
    }
    while (goal_yaw && std::abs(to(*goal_yaw)) > kSettled) step(to(*goal_yaw));
  }

  void rest_until(std::size_t states) {
    const auto needed = states + 2 * static_cast<std::size_t>(half_window_);
    const auto settled = raw_.size() + static_cast<std::size_t>(half_window_);
    raw_.resize(std::max(needed, settled + static_cast<std::size_t>(half_window_)), raw_.back());
  }

  [[nodiscard]] const std::vector<double>& raw() const { return raw_; }

 private:
  [[nodiscard]] double to(double yaw) const { return wrapped(yaw - raw_.back()); }
  void step(double turn) {
    raw_.push_back(raw_.back() + std::clamp(turn, -most_step_, most_step_));
  }

  int half_window_;
  double most_step_;         // rad
  std::vector<double> raw_;  // rad; half a window before the start comes first
};

}  // namespace

std::vector<YawState> yaw_along(const std::vector<Eigen::Vector3d>& velocities, double step_s,
                                const YawState& start, std::optional<double> goal_yaw,
                                const LimitsConfig& limits) {
  const double most_rate = limits.max_yaw_rate_deg * std::numbers::pi / 180;
  const double half_window_s = limits.max_yaw_rate_deg / limits.max_yaw_acceleration_deg;
  const int half_window = std::max(1, static_cast<int>(std::ceil(half_window_s / step_s)));

  Turning turning(start, half_window, step_s, most_rate);
  turning.follow(velocities, goal_yaw);
  turning.rest_until(velocities.size());

  const std::vector<double>& raw = turning.raw();
  const std::size_t window = 2 * static_cast<std::size_t>(half_window);
  double sum = 0;  // of trapezoids over the window
  for (std::size_t k = 0; k < window; ++k) sum += 0.5 * (raw[k] + raw[k + 1]);
  std::vector<YawState> states;
  for (std::size_t k = 0; k + window < raw.size(); ++k) {
    const double width = static_cast<double>(window);
    states.push_back({sum / width, (raw[k + window] - raw[k]) / (width * step_s)});
    if (k + window + 1 < raw.size())
      sum += 0.5 * (raw[k + window] + raw[k + window + 1] - raw[k] - raw[k + 1]);
  }
  return states;
}

}  // namespace saker::motion
