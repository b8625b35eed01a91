#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "flight/run_files/trajectory_file.h"
#include "saker/autonomy/lockstep.h"
#include "saker/objects/object_map.h"

namespace saker::tools {

using flight::pose_at;
using flight::read_trajectory;
using flight::StampedPose;

/// What a simulator knows of a recording: the objects, and the trajectory where
/// `trajectory_truth.txt` (TUM rows) lies beside truth.json.
struct Truth {
  objects::ObjectMap map;
  std::vector<StampedPose> trajectory;
};

/// Throws Error where a file is missing or malformed; a missing trajectory is none.
[[nodiscard]] Truth read_truth(const std::filesystem::path& file, const objects::ClassTable& table);

/// RMS and greatest error of position (m), RMS error of rotation (deg) over the scans whose stamp
/// (to 1 ms) the truth has, as given: without alignment, since both start in the same frame. Null
/// where no stamp is the same.
[[nodiscard]] nlohmann::json trajectory_figures(std::span<const autonomy::ScanRecord> scans,
                                                std::span<const SE3> T_world_lidar,
                                                const std::vector<StampedPose>& truth);

}  // namespace saker::tools
