#pragma once

#include "flight/viewers/json_value.h"
#include "saker/core/se3.h"

/// Parts that Foxglove's messages share.
namespace saker::flight::viewers {

/// Seconds as {sec, nsec}; of what is no time: 0.
[[nodiscard]] Json time_json(double t);
/// Finite vectors as {x, y, z}.
[[nodiscard]] Json vector_json(const Eigen::Vector3d& v);
[[nodiscard]] Json quaternion_json(const Eigen::Quaterniond& q);
[[nodiscard]] Json pose_json(const SE3& T);
[[nodiscard]] Json colour_json(const core::Colour& colour, double opacity);

}  // namespace saker::flight::viewers
