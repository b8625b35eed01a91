#pragma once

#include <array>
#include <string>
#include <string_view>

#include "saker/command_ack_t.hpp"
#include "saker/command_t.hpp"
#include "saker/detections_t.hpp"
#include "saker/exchange_t.hpp"
#include "saker/health_t.hpp"
#include "saker/mission_t.hpp"
#include "saker/object_map_t.hpp"
#include "saker/occupancy_t.hpp"
#include "saker/odometry_t.hpp"
#include "saker/order_t.hpp"
#include "saker/plan_t.hpp"
#include "saker/presence_t.hpp"
#include "saker/scan_t.hpp"
#include "saker/setpoint_t.hpp"
#include "saker/trajectory_t.hpp"
#include "saker/vehicle_state_t.hpp"
#include "saker/verdict_t.hpp"

/// Which message travels where: one channel a type, named after the robot, as lcmtypes/channels.txt
/// has it (a test compares the two).
namespace saker::flight {

enum class Network { control, bulk };

struct Channel {
  const char* suffix;
  Network network;
};

template <class Message>
inline constexpr Channel kChannel = {nullptr, Network::control};

template <>
inline constexpr Channel kChannel<vehicle_state_t> = {"_STATE", Network::control};
template <>
inline constexpr Channel kChannel<command_t> = {"_COMMAND", Network::control};
template <>
inline constexpr Channel kChannel<command_ack_t> = {"_COMMAND_ACK", Network::control};
template <>
inline constexpr Channel kChannel<setpoint_t> = {"_SETPOINT", Network::control};
template <>
inline constexpr Channel kChannel<odometry_t> = {"_ODOMETRY", Network::control};
template <>
inline constexpr Channel kChannel<scan_t> = {"_SCAN", Network::bulk};
template <>
inline constexpr Channel kChannel<trajectory_t> = {"_TRAJECTORY", Network::control};
template <>
inline constexpr Channel kChannel<verdict_t> = {"_VERDICT", Network::control};
template <>
inline constexpr Channel kChannel<occupancy_t> = {"_OCCUPANCY", Network::bulk};
template <>
inline constexpr Channel kChannel<object_map_t> = {"_OBJECTS", Network::control};
template <>
inline constexpr Channel kChannel<detections_t> = {"_DETECTIONS", Network::control};
template <>
inline constexpr Channel kChannel<plan_t> = {"_PLAN", Network::control};
template <>
inline constexpr Channel kChannel<mission_t> = {"_MISSION", Network::control};
template <>
inline constexpr Channel kChannel<health_t> = {"_HEALTH", Network::control};
template <>
inline constexpr Channel kChannel<order_t> = {"_ORDER", Network::control};
template <>
inline constexpr Channel kChannel<exchange_t> = {"_EXCHANGE", Network::control};
template <>
inline constexpr Channel kChannel<presence_t> = {"_PRESENCE", Network::control};

/// A robot's name, as a regular expression.
inline const std::string kAnyRobot = "[A-Z][A-Z0-9]{0,15}";

/// "R1_COMMAND_ACK" → "R1".
[[nodiscard]] inline std::string robot_of(const std::string& channel) {
  return channel.substr(0, channel.find('_'));
}

/// A channel's name without memory of its own: "R1" and "_STATE" are "R1_STATE".
class ChannelName {
 public:
  ChannelName(std::string_view robot, std::string_view suffix) {
    std::size_t size = 0;
    for (const std::string_view part : {robot, suffix})
      size += part.copy(bytes_.data() + size, bytes_.size() - 1 - size);
  }
  [[nodiscard]] const char* c_str() const { return bytes_.data(); }

 private:
  std::array<char, 64> bytes_{};  // LCM takes 63
};

/// "R1", "_STATE" → "R1_STATE".
template <class Message>
[[nodiscard]] std::string channel_name(const std::string& robot) {
  static_assert(kChannel<Message>.suffix != nullptr, "no channel for this type");
  return robot + kChannel<Message>.suffix;
}

}  // namespace saker::flight
