#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "saker/lidar/packet.h"
#include "saker/lidar/sensor_info.h"

/// A sensor whose every pixel is known: packets of a frame, and what they must decode to.
namespace saker::lidar::testing {

using Bytes = std::vector<std::uint8_t>;

inline constexpr Time kFrameTime = 1'000'000'000'000;

/// A range that differs in each pixel and frame, with gaps; fits every profile (multiples of 8 mm,
/// under 262 m).
inline std::uint32_t made_range(int frame, int row, int column) {
  const unsigned mixed = 2654435761U * (static_cast<unsigned>(row) * 4096U +
                                        static_cast<unsigned>(column) + 77U * frame);
  return (mixed >> 8) % 7 == 0 ? 0 : 800 + 8 * ((mixed >> 12) % 20000);
}

inline std::uint8_t made_reflectivity(int row, int column) {
  return static_cast<std::uint8_t>((3 * row + 5 * column) % 256);
}

inline Time made_time(const SensorInfo& info, int frame, int column) {
  return kFrameTime + from_seconds((frame * info.columns + column) * info.column_period_s());
}

/// `frame` counts from 0; the packets say `frame_id`.
inline Column made_column(const SensorInfo& info, int frame, int frame_id, int column) {
  Column made;
  made.time = made_time(info, frame, column);
  made.frame_id = frame_id;
  made.measurement_id = column;
  made.valid = info.column_window.contains(column);
  for (int row = 0; row < info.rows && made.valid; ++row) {
    made.pixels.push_back({made_range(frame, row, column), 0, 0, made_reflectivity(row, column)});
  }
  return made;
}

/// As a sensor sends them: in the order of columns, none without a column in the window.
inline std::vector<Bytes> made_packets(const SensorInfo& info, int frame, int frame_id) {
  const PacketFormat format(info);
  std::vector<Bytes> packets;
  for (int first = 0; first < info.columns; first += info.columns_per_packet) {
    std::vector<Column> columns;
    bool any = false;
    for (int i = 0; i < info.columns_per_packet; ++i) {
      columns.push_back(made_column(info, frame, frame_id, first + i));
      any = any || columns.back().valid;
    }
    if (any) packets.push_back(format.encode(columns));
  }
  return packets;
}

/// Staggered ranges of a whole frame.
inline std::vector<std::uint32_t> made_ranges(const SensorInfo& info, int frame) {
  std::vector<std::uint32_t> ranges;
  for (int row = 0; row < info.rows; ++row) {
    for (int column = 0; column < info.columns; ++column) {
      const bool sent = info.column_window.contains(column);
      ranges.push_back(sent ? made_range(frame, row, column) : 0);
    }
  }
  return ranges;
}

/// A folder for one test, removed with it.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "saker-test-XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  [[nodiscard]] std::filesystem::path operator/(const std::string& name) const {
    return path_ / name;
  }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace saker::lidar::testing
