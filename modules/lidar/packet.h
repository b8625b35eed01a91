#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "saker/core/time.h"
#include "saker/lidar/sensor_info.h"

/// Ouster's lidar packets, both ways: bytes to columns and columns to bytes.
///
/// A packet holds `columns_per_packet` columns of one frame, a column the returns of all beams at
/// one angle of the encoder. Layouts after the vendor's "Software User Manual", chapter "LiDAR data
/// format". Little-endian throughout.
namespace saker::lidar {

/// The first return of one beam.
struct Pixel {
  std::uint32_t range_mm = 0;  ///< 0: no return
  std::uint16_t signal = 0;    ///< photons
  std::uint16_t near_infrared = 0;
  std::uint8_t reflectivity = 0;

  bool operator==(const Pixel&) const = default;
};

/// One column, as decoded or as it is to be sent.
struct Column {
  Time time = 0;
  int frame_id = 0;        ///< 0 … 65535; of functional-safety sensors 0 … 2³¹ − 1
  int measurement_id = 0;  ///< column of the frame
  bool valid = true;       ///< false where the sensor's window leaves the column out
  std::vector<Pixel> pixels;
};

struct PacketSender {
  std::uint64_t serial_number = 0;
  std::uint32_t initialization_id = 0;  ///< changes when the sensor restarts

  bool operator==(const PacketSender&) const = default;
};

/// The same of any packet with a head, inertial ones included.
[[nodiscard]] PacketSender read_sender(std::span<const std::uint8_t> packet, PacketHeader header);

inline constexpr std::size_t kPacketHeadBytes = 32;  ///< the foot is as long

/// What a packet's bytes mean for one sensor.
class PacketFormat {
 public:
  explicit PacketFormat(const SensorInfo& info);

  [[nodiscard]] std::size_t packet_bytes() const { return packet_bytes_; }
  [[nodiscard]] int columns_per_packet() const { return columns_per_packet_; }
  [[nodiscard]] int rows() const { return rows_; }

  /// Of a packet that has `packet_bytes()`; `i` counts the packet's columns.
  [[nodiscard]] int frame_id(std::span<const std::uint8_t> packet, int i) const;
  [[nodiscard]] int measurement_id(std::span<const std::uint8_t> packet, int i) const;
  [[nodiscard]] Time time(std::span<const std::uint8_t> packet, int i) const;
  [[nodiscard]] bool valid(std::span<const std::uint8_t> packet, int i) const;

  /// Who sent the packet, as its head says; nothing in the profile LEGACY.
  [[nodiscard]] std::optional<PacketSender> sender(std::span<const std::uint8_t> packet) const;

  /// Range and reflectivity of each row, at `ranges[row · stride]` and so on: what a scan needs and
  /// nothing else.
  void read_column(std::span<const std::uint8_t> packet, int i, std::uint32_t* ranges,
                   std::uint8_t* reflectivity, std::size_t stride) const;

  /// Everything in one column: for tests and tools.
  [[nodiscard]] Column column(std::span<const std::uint8_t> packet, int i) const;

  /// The inverse: the columns of one packet, at most `columns_per_packet()` of one frame; the rest
  /// is left out as not valid. What a profile cannot hold is cut: near infrared and range are
  /// rounded down to its steps, a range beyond its largest is 0.
  [[nodiscard]] std::vector<std::uint8_t> encode(std::span<const Column> columns) const;

  /// A range in whole steps of the profile, as it will be decoded.
  [[nodiscard]] std::uint32_t representable_mm(std::uint32_t range_mm) const;

 private:
  [[nodiscard]] std::span<const std::uint8_t> column_bytes(std::span<const std::uint8_t> packet,
                                                           int i) const;
  [[nodiscard]] Pixel pixel(const std::uint8_t* bytes) const;
  void write_pixel(const Pixel& pixel, std::uint8_t* bytes) const;
  void write_column(const Column& column, std::uint8_t* bytes) const;

  PacketProfile profile_;
  PacketHeader header_;
  int rows_;
  int columns_;
  int columns_per_packet_;
  int initialization_id_;
  std::uint64_t serial_number_;
  std::size_t pixel_bytes_;
  std::size_t column_head_bytes_;
  std::size_t column_bytes_;
  std::size_t packet_head_bytes_;
  std::size_t packet_bytes_;
};

}  // namespace saker::lidar
