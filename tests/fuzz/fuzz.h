#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "saker/core/error.h"
#include "saker/lidar/cursor.h"
#include "saker/lidar/recording.h"
#include "saker/lidar/sensor_info.h"

/// What the targets share. What is wrong ends the program; an Error is an answer.
namespace saker::lidar::fuzz {

/// Of the input; what a target is.
void run(ByteView input);

/// Ends the program where something is wrong.
void expect(bool right);

[[nodiscard]] inline ByteView bytes_of(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

/// A file that holds the input, the same one each time.
[[nodiscard]] std::filesystem::path file_of(ByteView input, const std::string& extension);

/// All frames, each with as many reflectivities, times and rings as points.
void read_all(ScanSource& source);
void expect_consistent(const Frame& frame);

/// The sensor of seeds and of targets that need one: 16 rows of 512 columns.
[[nodiscard]] inline SensorInfo sensor(PacketProfile profile) {
  return SensorInfo::make_os1(16, 512, profile);
}

}  // namespace saker::lidar::fuzz
