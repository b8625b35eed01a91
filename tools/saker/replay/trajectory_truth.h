#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "saker/autonomy/lockstep.h"
#include "saker/objects/object_map.h"

namespace saker::tools {

struct StampedPose {
  double t = 0;  ///< s
  SE3 T_world_lidar = SE3::Identity();
};

/// What a simulator knows of a recording: the objects, and the trajectory where
/// `trajectory_truth.txt` (TUM rows) lies beside truth.json.
struct Truth {
  objects::ObjectMap map;
  std::vector<StampedPose> trajectory;
};

/// TUM rows in time order; none where there is no such file. Throws Error on a malformed row.
[[nodiscard]] std::vector<StampedPose> read_trajectory(const std::filesystem::path& file);

/// The pose of that time, to 1 ms; null where there is none. `poses` in time order.
[[nodiscard]] const StampedPose* pose_at(const std::vector<StampedPose>& poses, double t);

/// Throws Error where a file is missing or malformed; a missing trajectory is none.
[[nodiscard]] Truth read_truth(const std::filesystem::path& file, const objects::ClassTable& table);

/// RMS and greatest error of position (m), RMS error of rotation (deg) over the scans whose stamp
/// (to 1 ms) the truth has, as given: without alignment, since both start in the same frame. Null
/// where no stamp is the same.
[[nodiscard]] nlohmann::json trajectory_figures(std::span<const autonomy::ScanRecord> scans,
                                                std::span<const SE3> T_world_lidar,
                                                const std::vector<StampedPose>& truth);

}  // namespace saker::tools
