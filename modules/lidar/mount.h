#pragma once

#include <vector>

#include "saker/core/config.h"
#include "saker/core/se3.h"

namespace saker::lidar {

/// How the LiDAR is mounted: T_body_lidar. The executive and the simulator read the same.
struct MountConfig {
  std::vector<double> position_m = {0, 0, 0.1};
  std::vector<double> rotation_deg = {0, 0, 0};

  template <class Visitor>
  void visit(Visitor& v) {
    v.setting("position_m", position_m, {-5, 5}, "m",
              "Place of the lidar's origin in body: x forward, y left, z up.");
    v.setting(
        "rotation_deg", rotation_deg, {-180, 180}, "°",
        "Roll, pitch (positive: nose down) and yaw of the lidar in body: about z, then y, then x.");
  }
};

/// Throws Error when there are not three numbers each.
[[nodiscard]] SE3 mount_pose(const MountConfig& config);

}  // namespace saker::lidar
