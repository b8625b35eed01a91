#pragma once

#include <string>
#include <vector>

#include "saker/core/time.h"
#include "saker/objects/object_map.h"
#include "saker/simulation/sensor/scanner.h"

/// What is true, in the form of what the system says.
namespace saker::simulation {

/// Turns about z only; at its place.
[[nodiscard]] SE3 levelled(const SE3& T);

/// "t x y z qx qy qz qw" and a line's end; s and m.
[[nodiscard]] std::string tum_row(Time stamp, const SE3& T);

/// The objects that belong in a map, seen from `world`, each with the number of returns that hit
/// it: `hits` by ObjectId.
[[nodiscard]] objects::ObjectMap truth_map(const World& world, const SE3& T_world_sim,
                                           const std::vector<int>& hits);

/// Adds the returns from the part of an object that its model describes: from a trunk, not from its
/// crown.
void count_hits(const World& world, const CastScan& scan, std::vector<int>& hits);

}  // namespace saker::simulation
