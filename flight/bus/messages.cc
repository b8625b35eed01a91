#include "flight/bus/messages.h"

#include <algorithm>
#include <limits>

#include "flight/bus/fields.h"

namespace saker::flight {
namespace {

constexpr std::int64_t kNanosecondsPerMicrosecond = 1000;

// What the comments in lcmtypes allow.
constexpr std::int64_t kMostUtime = 9'000'000'000'000'000;  // us
constexpr double kLeastStep_s = 1e-3, kMostStep_s = 10;
constexpr float kMostHeight_m = 1e3F;

bool is_height(float metres) { return metres > 0 && metres <= kMostHeight_m; }

/// Whether its end is a time.
bool is_timed(const trajectory_t& message) {
  return message.step_s >= kLeastStep_s && message.step_s <= kMostStep_s &&
         message.start_utime >= 0 && message.start_utime <= kMostUtime;
}

motion_state_t to_lcm(const motion::MotionState& state) {
  motion_state_t message{};
  write_field(state.position, message.position);
  write_field(state.velocity, message.velocity);
  write_field(state.acceleration, message.acceleration);
  message.yaw = static_cast<float>(state.yaw);
  message.yaw_rate = static_cast<float>(state.yaw_rate);
  return message;
}

std::optional<motion::MotionState> from_lcm(const motion_state_t& message) {
  const motion::MotionState state{.position = vector_of(message.position),
                                  .velocity = vector_of(message.velocity),
                                  .acceleration = vector_of(message.acceleration),
                                  .yaw = message.yaw,
                                  .yaw_rate = message.yaw_rate};
  const bool whole = state.position.allFinite() && state.velocity.allFinite() &&
                     state.acceleration.allFinite() && std::isfinite(state.yaw) &&
                     std::isfinite(state.yaw_rate);
  return whole ? std::optional(state) : std::nullopt;
}

}  // namespace

std::int64_t to_utime(Time time) {
  const std::int64_t down = time % kNanosecondsPerMicrosecond < 0 ? 1 : 0;
  return time / kNanosecondsPerMicrosecond - down;
}

Time from_utime(std::int64_t utime) {
  constexpr std::int64_t kMost = std::numeric_limits<Time>::max() / kNanosecondsPerMicrosecond;
  return std::clamp(utime, -kMost, kMost) * kNanosecondsPerMicrosecond;
}

std::string shortened(const std::string& text, int most) {
  return text.substr(0, static_cast<std::size_t>(most));
}

vehicle_state_t to_lcm(const VehicleState& state) {
  vehicle_state_t message{};
  message.utime = to_utime(state.stamp);
  message.armed = state.armed;
  message.mode = static_cast<std::int8_t>(state.mode);
  write_rotation(state.attitude, message.attitude);
  message.height_m = static_cast<float>(state.height_m);
  message.battery_share = static_cast<float>(state.battery_share);
  message.faults = static_cast<std::int32_t>(state.faults);
  return message;
}

std::optional<VehicleState> from_lcm(const vehicle_state_t& message) {
  const auto mode = enumerator_of(message.mode, VehicleMode::descend);
  const auto attitude = rotation_of(message.attitude);
  if (!mode || !attitude) return std::nullopt;
  return VehicleState{.stamp = from_utime(message.utime),
                      .armed = message.armed != 0,
                      .mode = *mode,
                      .attitude = *attitude,
                      .height_m = message.height_m,
                      .battery_share = message.battery_share,
                      .faults = static_cast<std::uint32_t>(message.faults)};
}

command_t to_lcm(const Command& command) {
  command_t message{};
  message.utime = to_utime(command.stamp);
  message.id = command.id;
  message.kind = static_cast<std::int8_t>(command.kind);
  message.height_m = static_cast<float>(command.height_m);
  return message;
}

std::optional<Command> from_lcm(const command_t& message) {
  const auto kind = enumerator_of(message.kind, CommandKind::resume);
  if (!kind || (*kind == CommandKind::takeoff && !is_height(message.height_m))) return std::nullopt;
  return Command{.stamp = from_utime(message.utime),
                 .id = message.id,
                 .kind = *kind,
                 .height_m = message.height_m};
}

command_ack_t to_lcm(const CommandAck& ack) {
  command_ack_t message{};
  message.utime = to_utime(ack.stamp);
  message.id = ack.id;
  message.accepted = ack.accepted;
  message.reason = shortened(ack.reason, command_ack_t::MAX_REASON);
  return message;
}

std::optional<CommandAck> from_lcm(const command_ack_t& message) {
  return CommandAck{.stamp = from_utime(message.utime),
                    .id = message.id,
                    .accepted = message.accepted != 0,
                    .reason = shortened(message.reason, command_ack_t::MAX_REASON)};
}

setpoint_t to_lcm(const Setpoint& setpoint) {
  setpoint_t message{};
  message.utime = to_utime(setpoint.stamp);
  message.expiry_utime = to_utime(setpoint.expiry);
  write_field(setpoint.position, message.position);
  write_field(setpoint.velocity, message.velocity);
  write_field(setpoint.acceleration, message.acceleration);
  message.yaw = static_cast<float>(setpoint.yaw);
  message.yaw_rate = static_cast<float>(setpoint.yaw_rate);
  return message;
}

std::optional<Setpoint> from_lcm(const setpoint_t& message) {
  const Setpoint setpoint{.stamp = from_utime(message.utime),
                          .expiry = from_utime(message.expiry_utime),
                          .position = vector_of(message.position),
                          .velocity = vector_of(message.velocity),
                          .acceleration = vector_of(message.acceleration),
                          .yaw = message.yaw,
                          .yaw_rate = message.yaw_rate};
  const bool whole = setpoint.position.allFinite() && setpoint.velocity.allFinite() &&
                     setpoint.acceleration.allFinite() && std::isfinite(setpoint.yaw) &&
                     std::isfinite(setpoint.yaw_rate);
  return whole ? std::optional(setpoint) : std::nullopt;
}

odometry_t to_lcm(const VehicleOdometry& odometry) {
  odometry_t message{};
  message.utime = to_utime(odometry.stamp);
  write_pose(odometry.T_odom_body, message.position, message.orientation);
  write_field(odometry.velocity, message.velocity);
  write_field(odometry.angular_velocity, message.angular_velocity);
  write_field(odometry.covariance.reshaped<Eigen::RowMajor>(), message.covariance);
  message.status = static_cast<std::int8_t>(odometry.status);
  message.reset_counter = odometry.reset_counter;
  return message;
}

std::optional<VehicleOdometry> from_lcm(const odometry_t& message) {
  const auto T = pose_of(message.position, message.orientation);
  const auto status = enumerator_of(message.status, VehicleOdometryStatus::lost);
  if (!T || !status) return std::nullopt;
  using RowMajor = Eigen::Matrix<float, 6, 6, Eigen::RowMajor>;
  return VehicleOdometry{
      .stamp = from_utime(message.utime),
      .T_odom_body = *T,
      .velocity = vector_of(message.velocity),
      .angular_velocity = vector_of(message.angular_velocity),
      .covariance = Eigen::Map<const RowMajor>(message.covariance).cast<double>(),
      .status = *status,
      .reset_counter = message.reset_counter};
}

std::optional<trajectory_t> to_lcm(const motion::Trajectory& trajectory, Time now) {
  if (trajectory.states.size() > trajectory_t::MAX_STATES) return std::nullopt;
  trajectory_t message{};
  message.utime = to_utime(now);
  message.id = trajectory.id;
  message.start_utime = to_utime(trajectory.start);
  message.step_s = trajectory.step_s;
  message.num_states = static_cast<std::int32_t>(trajectory.states.size());
  for (const motion::MotionState& state : trajectory.states) {
    message.states.push_back(to_lcm(state));
  }
  return message;
}

std::optional<motion::Trajectory> from_lcm(const trajectory_t& message) {
  const bool sized = message.states.size() <= trajectory_t::MAX_STATES &&
                     (message.states.empty() || is_timed(message));
  if (!sized) return std::nullopt;
  motion::Trajectory trajectory{.id = message.id,
                                .start = from_utime(message.start_utime),
                                .step_s = message.step_s,
                                .states = {}};
  for (const motion_state_t& state_message : message.states) {
    const auto state = from_lcm(state_message);
    if (!state) return std::nullopt;
    trajectory.states.push_back(*state);
  }
  return trajectory;
}

verdict_t to_lcm(const motion::Verdict& verdict) {
  verdict_t message{};
  message.utime = to_utime(verdict.stamp);
  message.trajectory_id = verdict.trajectory_id;
  message.clear = verdict.clear;
  message.reason = static_cast<std::int8_t>(verdict.reason);
  message.clear_until_utime = to_utime(verdict.clear_until);
  write_field(verdict.first_hit, message.first_hit);
  message.clearance_m = static_cast<float>(verdict.clearance_m);
  return message;
}

std::optional<motion::Verdict> from_lcm(const verdict_t& message) {
  const auto reason = enumerator_of(message.reason, motion::VerdictReason::no_trajectory);
  if (!reason) return std::nullopt;
  return motion::Verdict{.stamp = from_utime(message.utime),
                         .trajectory_id = message.trajectory_id,
                         .clear = message.clear != 0,
                         .reason = *reason,
                         .clear_until = from_utime(message.clear_until_utime),
                         .first_hit = vector_of(message.first_hit),
                         .clearance_m = message.clearance_m};
}

}  // namespace saker::flight
