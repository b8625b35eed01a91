#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "saker/core/time.h"
#include "saker/lidar/packet.h"
#include "saker/lidar/sensor_info.h"

/// What a live packet says of itself, as far as the gate (sensor_gate.h) holds it against others.
namespace saker::lidar {

enum class SensorStream { lidar, imu };

/// Stamps are at least 0 and less than this: 146 years. Sums and differences of two then fit.
inline constexpr Time kStampEnd = Time{1} << 62;

/// A column and its time.
struct ColumnTime {
  int frame_id = 0;
  int column = 0;
  Time stamp = 0;
};

struct SensorReading {
  SensorStream stream = SensorStream::lidar;
  std::optional<PacketSender> sender;  ///< serial number and init id; nothing in old profiles
  bool any = false;                    ///< a column that is valid, or a sample
  ColumnTime first, last;              ///< of a lidar packet: its valid columns
  Time oldest = 0, newest = 0;         ///< stamps, ns of the sensor's clock
  int samples = 0;                     ///< of the inertial unit
};

enum class ReadingFault { none, shape, columns, stamp };

struct ReadPacket {
  SensorReading reading;
  ReadingFault fault = ReadingFault::none;
};

/// Any bytes are allowed. `shape`: neither a lidar packet of this sensor nor an inertial one;
/// `columns`: they are not of one frame, not in a row, or their times are not; `stamp`: one that is
/// no time, or samples that go back.
[[nodiscard]] ReadPacket read_sensor_packet(std::span<const std::uint8_t> payload,
                                            const PacketFormat& format, const SensorInfo& info);

/// Adds to every stamp of a packet that was read without a fault.
void add_to_stamps(std::span<std::uint8_t> payload, Time correction, const PacketFormat& format,
                   const SensorInfo& info);

}  // namespace saker::lidar
