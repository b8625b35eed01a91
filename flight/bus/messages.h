#pragma once

#include <optional>
#include <string>

#include "flight/bus/channels.h"
#include "saker/core/vehicle.h"
#include "saker/motion/trajectory.h"

/// The edge: plain structs ↔ LCM messages. Stamps lose what is below 1 µs (rounded down). Reading
/// gives nothing where a field contradicts its comment in lcmtypes: wrong enumerators, sizes, or
/// not a number where the field has to be one. Scans and occupancy: scan_messages.h,
/// occupancy_messages.h; objects: object_messages.h.
namespace saker::flight {

[[nodiscard]] std::int64_t to_utime(Time time);
[[nodiscard]] Time from_utime(std::int64_t utime);

/// Cut to `most` bytes, for texts with a ceiling.
[[nodiscard]] std::string shortened(const std::string& text, int most);

[[nodiscard]] vehicle_state_t to_lcm(const VehicleState& state);
[[nodiscard]] std::optional<VehicleState> from_lcm(const vehicle_state_t& message);

[[nodiscard]] command_t to_lcm(const Command& command);
[[nodiscard]] std::optional<Command> from_lcm(const command_t& message);

[[nodiscard]] command_ack_t to_lcm(const CommandAck& ack);
[[nodiscard]] std::optional<CommandAck> from_lcm(const command_ack_t& message);

[[nodiscard]] setpoint_t to_lcm(const Setpoint& setpoint);
[[nodiscard]] std::optional<Setpoint> from_lcm(const setpoint_t& message);

[[nodiscard]] odometry_t to_lcm(const VehicleOdometry& odometry);
[[nodiscard]] std::optional<VehicleOdometry> from_lcm(const odometry_t& message);

/// \param now  when it is sent
/// Nothing for a trajectory of more than trajectory_t::MAX_STATES states: cut short it would not
/// end at rest.
[[nodiscard]] std::optional<trajectory_t> to_lcm(const motion::Trajectory& trajectory, Time now);
[[nodiscard]] std::optional<motion::Trajectory> from_lcm(const trajectory_t& message);

[[nodiscard]] verdict_t to_lcm(const motion::Verdict& verdict);
[[nodiscard]] std::optional<motion::Verdict> from_lcm(const verdict_t& message);

}  // namespace saker::flight
