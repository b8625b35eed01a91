#pragma once

#include <filesystem>
#include <vector>

#include "saker/core/se3.h"

namespace saker::flight {

struct StampedPose {
  double t = 0;  ///< s
  SE3 T_world_lidar = SE3::Identity();
};

/// TUM rows in time order; none where there is no such file. Throws Error on a malformed row.
[[nodiscard]] std::vector<StampedPose> read_trajectory(const std::filesystem::path& file);

/// The pose of that time, to 1 ms; null where there is none. `poses` in time order.
[[nodiscard]] const StampedPose* pose_at(const std::vector<StampedPose>& poses, double t);

}  // namespace saker::flight
