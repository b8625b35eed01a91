#pragma once

#include <filesystem>
#include <vector>

namespace saker::lidar {

/// What a recording is, by its content.
enum class RecordingKind {
  kUnknown,
  kFloatScans,  ///< `*.bin`: a folder or a single scan
  kClouds,      ///< PCD, PLY, .npy: a folder or a single scan
  kCapture,     ///< pcap, pcapng
  kOsf,         ///< Ouster's own
  kRos1Bag,
  kMcap,
  kRos2Database  ///< SQLite of a ROS 2 bag
};

struct RecordingParts {
  RecordingKind kind = RecordingKind::kUnknown;
  std::vector<std::filesystem::path> files;  ///< of a recording in one or several files, in order
};

/// Throws Error when the path holds recordings of several kinds, or several captures.
[[nodiscard]] RecordingParts recording_parts(const std::filesystem::path& path);

/// Of one file.
[[nodiscard]] RecordingKind recording_kind(const std::filesystem::path& file);

}  // namespace saker::lidar
