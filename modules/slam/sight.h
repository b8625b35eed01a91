#pragma once

#include <span>
#include <vector>

#include "saker/objects/models.h"
#include "saker/slam/landmark.h"

namespace saker::slam {

/// The vehicles of the map, and what else is a cuboid in it (world).
[[nodiscard]] std::vector<objects::Cuboid> believed_cuboids(std::span<const Landmark> landmarks,
                                                            const LandmarkConfig& config);

/// Whether the robot at `eye` (world, m) should measure a landmark: no farther than where it was
/// measured, not so near that the sensor looks over it, and none of the cuboids before it.
[[nodiscard]] bool in_view(const Landmark& landmark, const Eigen::Vector3d& eye,
                           std::span<const objects::Cuboid> cuboids, const LandmarkConfig& config);

/// Whether a cuboid lies between two points, neither of which is in it (slabs: Kay and Kajiya, "Ray
/// Tracing Complex Scenes", 1986).
[[nodiscard]] bool between(const objects::Cuboid& cuboid, const Eigen::Vector3d& from,
                           const Eigen::Vector3d& to);

}  // namespace saker::slam
