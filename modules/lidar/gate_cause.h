#pragma once

namespace saker::lidar {

/// Why a live packet is not believed (sensor_gate.h).
enum class GateCause {
  none,        ///< it passes
  waits,       ///< inertial: the lidar's next packets tell of which clock its stamps are
  not_agreed,  ///< no sensor is known yet
  shape,
  address,
  port,
  serial_number,
  restarted,  ///< another init id
  stamp,      ///< no time at all
  ahead,      ///< of its arrival
  late,
  back,          ///< inertial: not newer than the one before
  frame,         ///< its stamps are not those of its frame and column
  columns,       ///< not in a row
  out_of_order,  ///< overtaken by too many
  too_many       ///< more than twice the sensor's rate
};
inline constexpr int kGateCauses = static_cast<int>(GateCause::too_many) + 1;

[[nodiscard]] const char* to_string(GateCause cause);  ///< "from another address"

}  // namespace saker::lidar
