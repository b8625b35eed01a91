#pragma once

#include <Eigen/Core>
#include <vector>

#include "saker/core/rng.h"

namespace saker::motion {

class FreeSpace;

/// Corners of a path of straight legs.
using Waypoints = std::vector<Eigen::Vector3d>;

[[nodiscard]] double length_m(const Waypoints& path);

/// The path with every corner left out that need not be there, then `tries` times a random piece
/// replaced by a straight leg if that is free. Never longer; start and end stay.
[[nodiscard]] Waypoints shortened(const Waypoints& path, const FreeSpace& space, int tries,
                                  core::Rng rng);

}  // namespace saker::motion
