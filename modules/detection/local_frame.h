#pragma once

#include "saker/core/se3.h"
#include "saker/objects/models.h"

namespace saker::detection {

/// The frame of the local ground: origin under p on the plane, z its normal, x the level frame's x
/// as far as the plane allows. \return T_level_local
[[nodiscard]] inline SE3 local_frame(const objects::GroundPlane& ground, const Eigen::Vector3d& p) {
  SE3 T = SE3::Identity();
  const Eigen::Vector3d z = ground.normal;
  const Eigen::Vector3d x = (Eigen::Vector3d::UnitX() - z.x() * z).normalized();
  T.linear() << x, z.cross(x), z;
  T.translation() = p - ground.height_of(p) * z;
  return T;
}

}  // namespace saker::detection
