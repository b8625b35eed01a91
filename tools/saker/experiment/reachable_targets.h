#pragma once

#include <vector>

#include "saker/active/views/field_of_view.h"
#include "saker/motion/geofence.h"
#include "saker/objects/object_map.h"
#include "saker/simulation/vehicle/collision.h"

namespace saker::tools {

/// Where a vehicle flies: the true world, and the fence that it must keep.
struct ReachableSpace {
  const simulation::World& world;
  const simulation::RayCaster& caster;
  SE3 T_sim_world = SE3::Identity();
  motion::GeofenceConfig fence;  ///< `world`
  double radius_m = NAN;         ///< of the vehicle's sphere
};

/// Which targets can be mapped at all. Reads the true world and the geofence, makes the ids of
/// those targets that at least one viewpoint has: a place inside the fence, clear of the world by
/// the vehicle's radius, that has the whole target in its field of view and its middle in a free
/// line of sight. What a policy did plays no part.
///
/// Frames: targets and fence are in `world`. Method: a lattice around the target, every 15°, every
/// metre up to `view.farthest_m`, every half metre of height in the fence. Cost: at most some
/// 0.1 s a target, for one that has no viewpoint.
[[nodiscard]] std::vector<int> reachable_targets(const std::vector<int>& targets,
                                                 const objects::ObjectMap& truth,
                                                 const ReachableSpace& space,
                                                 const active::FieldOfViewConfig& view);

}  // namespace saker::tools
