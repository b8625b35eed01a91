#include "saker/lidar/mount.h"

#include <fmt/format.h>

#include <numbers>

#include "saker/core/error.h"

namespace saker::lidar {

SE3 mount_pose(const MountConfig& config) {
  if (config.position_m.size() != 3 || config.rotation_deg.size() != 3) {
    throw Error(
        fmt::format("mount: {} and {} numbers, expected three of position_m and three of "
                    "rotation_deg",
                    config.position_m.size(), config.rotation_deg.size()));
  }
  const auto turn = [&](int axis) {
    const double angle = config.rotation_deg[static_cast<std::size_t>(axis)];
    return Eigen::AngleAxisd(angle * std::numbers::pi / 180, Eigen::Vector3d::Unit(axis));
  };
  SE3 T = SE3::Identity();
  T.linear() = (turn(2) * turn(1) * turn(0)).toRotationMatrix();
  T.translation() = Eigen::Vector3d::Map(config.position_m.data());
  return T;
}

}  // namespace saker::lidar
