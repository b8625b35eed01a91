#pragma once

#include <cstdint>

#include "flight/mavlink/config.h"
#include "saker/core/time.h"

/// Where PX4 and ArduPilot differ: numbers of modes, and what each does with setpoints.
///
/// Sources: ArduPilot's copter modes and PX4's px4_custom_mode.h, both public; flown with
/// ArduCopter 4.6, read in PX4's sources.
namespace saker::flight::mavlink {

/// A mode as DO_SET_MODE takes it, and as HEARTBEAT shows it.
struct ModeNumber {
  float main = 0, sub = 0;
  std::uint32_t custom = 0;  ///< HEARTBEAT's custom_mode
};

struct Dialect {
  Autopilot autopilot = Autopilot::ardupilot;
  std::uint8_t heartbeat_kind = 3;  ///< HEARTBEAT's autopilot
  ModeNumber guided, hold, land;
  /// Takes off by its own command, which setpoints would cancel; else by setpoints that climb.
  bool own_takeoff = true;
  Time stream_before_guided = 0;  ///< for which setpoints come before the mode is asked for
  bool resets_yaw = true;         ///< follows a reset of the heading of our odometry
  std::uint16_t estimator_message = 193;
};

[[nodiscard]] inline Dialect dialect_of(Autopilot autopilot) {
  constexpr auto px4 = [](std::uint32_t main, std::uint32_t sub) {
    return ModeNumber{static_cast<float>(main), static_cast<float>(sub), main << 16 | sub << 24};
  };
  if (autopilot == Autopilot::px4)
    return {.autopilot = autopilot,
            .heartbeat_kind = 12,
            .guided = px4(6, 0),
            .hold = px4(4, 3),
            .land = px4(4, 6),
            .own_takeoff = false,
            .stream_before_guided = 2 * kNanosecondsPerSecond,
            .resets_yaw = true,
            .estimator_message = 230};
  return {.autopilot = autopilot,
          .heartbeat_kind = 3,
          .guided = {4, 0, 4},
          .hold = {4, 0, 4},  // guided, with a setpoint that stands
          .land = {9, 0, 9},
          .own_takeoff = true,
          .stream_before_guided = 0,
          .resets_yaw = false,
          .estimator_message = 193};
}

/// EXTENDED_SYS_STATE's landed_state.
enum class Landed : std::uint8_t {
  unknown = 0,
  on_ground = 1,
  in_air = 2,
  takeoff = 3,
  landing = 4
};

inline constexpr std::uint8_t kArmedFlag = 128, kCustomModeFlag = 1;  ///< HEARTBEAT's base_mode
inline constexpr std::uint8_t kCritical = 5;                          ///< its system_status

}  // namespace saker::flight::mavlink
