#pragma once

#include <cstdint>
#include <vector>

#include "saker/lidar/packet.h"
#include "tools/saker/faults/fault.h"

namespace saker::tools {

/// What is wrong with a sensor's packets — reads and makes UDP payloads, lidar or inertial: clocks
/// that drift or step, an inertial unit with a bias, that shakes or saturates, rows without
/// returns, a covered part of the view, drops of rain before the beams, bytes of nothing; and what
/// others send beside it: copies, and packets of another time and frame.
class PacketFaults {
 public:
  /// `schedule` has to outlive this.
  PacketFaults(const FaultSchedule& schedule, const lidar::SensorInfo& sensor);

  /// The packet as it would have been sent at `t_s`.
  void apply(double t_s, std::vector<std::uint8_t>& payload);

  /// What else comes with it, as it is after `apply`.
  [[nodiscard]] std::vector<std::vector<std::uint8_t>> company(
      double t_s, const std::vector<std::uint8_t>& payload);

 private:
  [[nodiscard]] Time clock_error(double t_s) const;
  void apply_to_imu(double t_s, Time clock, std::vector<std::uint8_t>& payload);
  void apply_to_lidar(double t_s, Time clock, std::vector<std::uint8_t>& payload);
  void spoil(lidar::Column& column, const Fault* dead, const Fault* covered, const Fault* drops);
  [[nodiscard]] std::vector<std::uint8_t> forged(const std::vector<std::uint8_t>& payload,
                                                 Time ahead);
  [[nodiscard]] bool garbled(FaultPlace place, double t_s, std::vector<std::uint8_t>& payload);

  const FaultSchedule& schedule_;
  lidar::SensorInfo sensor_;
  lidar::PacketFormat format_;
  core::Rng rng_;
};

}  // namespace saker::tools
