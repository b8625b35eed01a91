#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

#include "saker/lidar/recording.h"

/// What every reader owes to a recording that was cut or damaged.
namespace saker::lidar::testing {

/// Bytes cut at about a hundred places, and with one to eight of them changed a hundred times; one
/// half of the changes lies in the first kilobyte, where the heads are.
void for_each_damage(const std::vector<std::uint8_t>& whole,
                     const std::function<void(const std::vector<std::uint8_t>&)>& visit);

/// A frame's points, reflectivities, times and ring numbers are as many as one another, its numbers
/// are inside their bounds, and a fault is a line and comes without points.
void expect_consistent(const Frame& frame);

/// Writes each damage of `whole` to `file` and reads all of it: it is refused with one line, or
/// gives at most twice the frames of the whole recording, each consistent. No damage takes more
/// than 512 MiB.
void expect_survives_damage(const std::vector<std::uint8_t>& whole,
                            const std::filesystem::path& file,
                            const RecordingOptions& options = {});

}  // namespace saker::lidar::testing
