#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "saker/lidar/recording.h"

namespace saker::tools {

/// What every command that reads recordings takes.
struct RecordingInput {
  std::string path;
  lidar::RecordingOptions options;

  /// Throws Error; says what a user has to know about the recording.
  [[nodiscard]] std::unique_ptr<lidar::ScanSource> open() const;
};

/// The argument `name` and --meta, --sensor, --topic, --point-fields.
void add_recording_input(CLI::App& app, const std::string& name, RecordingInput& input);

/// As --help says what may be given.
inline constexpr const char* kRecordings =
    "a folder of scans (*.bin, PCD, PLY, .npy) or one, a capture (*.pcap) of Ouster, Velodyne or "
    "Hesai, OSF, a ROS bag (1, 2) or MCAP, told by its content";

}  // namespace saker::tools
