#pragma once

#include <span>

#include "objects/models.h"
#include "slam/landmark.h"

namespace saker::slam {

/// Whether the robot at `eye` (world, m) should measure a landmark: no farther than where it was
/// measured, not so near that the sensor looks over it, and no other one of the map in the way.
[[nodiscard]] bool in_view(const Landmark& landmark, const Eigen::Vector3d& eye,
                           std::span<const Landmark> landmarks, const LandmarkConfig& config);

/// Whether a cuboid is crossed by the way from one point to the other: the part of the way within
/// each pair of its faces (slabs: Kay and Kajiya, Ray Tracing Complex Scenes, 1986).
[[nodiscard]] bool crosses(const objects::Cuboid& cuboid, const Eigen::Vector3d& from,
                           const Eigen::Vector3d& to);

}  // namespace saker::slam
