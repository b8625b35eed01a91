#include "saker/motion/braking.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace saker::motion {
namespace {

constexpr Time kFine = kNanosecondsPerSecond / 200;  // of the sum of a path's length
constexpr double kStands_mps = 1e-3;                 // slower ones have no direction

/// A trajectory by its length from a moment on.
class Way {
 public:
  Way(const Trajectory& trajectory, Time begin)
      : trajectory_(trajectory), time_(begin), speed_(speed_at(begin)) {}

  /// When the trajectory has gone so far; distances are asked for in ascending order.
  [[nodiscard]] Time time_at(double distance_m) {
    while (time_ < trajectory_.end()) {
      const double next_speed = speed_at(time_ + kFine);
      const double piece = (speed_ + next_speed) / 2 * to_seconds(kFine);
      if (length_m_ + piece >= distance_m) {
        const double share = piece > 0 ? (distance_m - length_m_) / piece : 0;
        return time_ + static_cast<Time>(share * static_cast<double>(kFine));
      }
      length_m_ += piece;
      speed_ = next_speed;
      time_ += kFine;
    }
    return trajectory_.end();
  }

 private:
  [[nodiscard]] double speed_at(Time time) const {
    return trajectory_.sample(time).velocity.norm();
  }

  const Trajectory& trajectory_;
  Time time_;
  double speed_;
  double length_m_ = 0;
};

/// From the speed and acceleration that the trajectory has along itself.
StopProfile profile_of(const MotionState& state, const BrakingConfig& config) {
  const double speed = state.velocity.norm();
  if (speed < kStands_mps) return {0, 0, config};
  return {speed, state.acceleration.dot(state.velocity) / speed, config};
}

/// The same place on the path, passed at another speed: what bends the path bends it by the square.
void pass(MotionState& state, const StopProfile::State& along) {
  const double planned = state.velocity.norm();
  if (planned < kStands_mps) {
    state.velocity.setZero();
    state.acceleration.setZero();
    return;
  }
  const Eigen::Vector3d direction = state.velocity / planned;
  const Eigen::Vector3d across = state.acceleration - state.acceleration.dot(direction) * direction;
  const double slower = along.speed / planned;
  state.velocity = along.speed * direction;
  state.acceleration = along.acceleration * direction + slower * slower * across;
}

/// A turn that ends at a constant rate.
class TurnStop {
 public:
  TurnStop(const MotionState& begin, const BrakingConfig& config)
      : begin_(begin),
        slowing_(
            std::copysign(config.yaw_deceleration_deg * std::numbers::pi / 180, -begin.yaw_rate)),
        duration_s_(-begin.yaw_rate / slowing_) {}

  [[nodiscard]] double duration_s() const { return duration_s_; }

  void turn(MotionState& state, double t) const {
    const double turning_s = std::min(t, duration_s_);
    state.yaw = wrapped(begin_.yaw + turning_s * (begin_.yaw_rate + slowing_ * turning_s / 2));
    state.yaw_rate = t < duration_s_ ? begin_.yaw_rate + slowing_ * t : 0;
  }

 private:
  MotionState begin_;
  double slowing_;  // rad/s²
  double duration_s_;
};

}  // namespace

/// Deceleration grows to `peak`, stays, and ends; `peak` is that at which the speed ends with it.
StopProfile::StopProfile(double speed, double acceleration, const BrakingConfig& config)
    : begin_{0, speed, acceleration} {
  const double jerk = config.jerk_mps3;
  const double already = std::max(0.0, -acceleration);
  if (speed <= 0) return;
  if (speed <= already * already / (2 * jerk)) {  // about to stand: only the last phase is left
    phases_[0] = {2 * speed / already, already * already / (2 * speed)};
  } else {
    const double most = std::max(config.deceleration_mps2, already);
    const double peak = std::min(most, std::sqrt(jerk * speed + acceleration * acceleration / 2));
    const double left = speed + acceleration * acceleration / (2 * jerk) - peak * peak / jerk;
    phases_[0] = {(acceleration + peak) / jerk, -jerk};
    phases_[1] = {std::max(0.0, left) / peak, 0};
    phases_[2] = {peak / jerk, jerk};
  }
  for (const Phase& phase : phases_) duration_s_ += phase.duration_s;
}

StopProfile::State StopProfile::at(double t) const {
  const bool stands = t >= duration_s_;
  State state = begin_;
  for (const Phase& phase : phases_) {
    const double dt = std::clamp(t, 0.0, phase.duration_s);
    state.distance_m += dt * (state.speed + dt * (state.acceleration / 2 + dt * phase.jerk / 6));
    state.speed += dt * (state.acceleration + dt * phase.jerk / 2);
    state.acceleration += dt * phase.jerk;
    t -= dt;
  }
  state.speed = std::max(0.0, state.speed);
  if (stands) state.speed = state.acceleration = 0;
  return state;
}

Trajectory braked(const Trajectory& trajectory, Time now, const BrakingConfig& config,
                  std::vector<MotionState> memory) {
  const MotionState begin = trajectory.sample(now);
  const StopProfile profile = profile_of(begin, config);
  const TurnStop turn(begin, config);
  const double duration_s = std::max(profile.duration_s(), turn.duration_s());
  Way way(trajectory, now);
  Trajectory result;
  result.start = now;
  result.step_s = config.step_s;
  memory.clear();
  result.states = std::move(memory);
  const int steps = static_cast<int>(std::ceil(duration_s / config.step_s));
  for (int i = 0; i <= steps; ++i) {
    const double t = i * config.step_s;
    const StopProfile::State along = profile.at(t);
    MotionState state = trajectory.sample(way.time_at(along.distance_m));
    pass(state, along);
    turn.turn(state, t);
    result.states.push_back(state);
  }
  return result;
}

Time stands_at(const Trajectory& trajectory, Time now, const BrakingConfig& config) {
  const StopProfile profile = profile_of(trajectory.sample(now), config);
  return Way(trajectory, now).time_at(profile.at(profile.duration_s()).distance_m);
}

}  // namespace saker::motion
