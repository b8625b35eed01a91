#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "saker/active/views/expectation.h"
#include "saker/active/views/viewpoint.h"
#include "saker/core/se3.h"
#include "saker/core/time.h"
#include "saker/objects/object_map.h"
#include "saker/occupancy/grid.h"

/// What a decision is made from, and what it says.
///
/// Frames: object map, poses, viewpoints and lengths are in `world`, the occupancy block in `odom`.
namespace saker::active {

/// Where and when what is decided now begins to be flown: until then, what was committed before.
struct ActiveStart {
  Time stamp = 0;
  SE3 T_world_body = SE3::Identity();
};

/// What a decision is made from. `map` and `grid` may be absent at first.
struct ActiveInput {
  Time stamp = 0;
  SE3 T_world_body = SE3::Identity();
  SE3 T_world_odom = SE3::Identity();
  std::optional<ActiveStart> start;               ///< none: where the vehicle is
  std::shared_ptr<const objects::ObjectMap> map;  ///< world
  std::optional<Time> map_stamp;  ///< until when it holds what was measured; none: until now
  std::shared_ptr<const occupancy::OccupancyGrid> grid;  ///< odom
};

enum class ActiveStatus {
  flying,    ///< fly to `goal`, and stay there until it changes
  finished,  ///< no target is pending
  invalid,   ///< a pose that is not finite, or a stamp that is not newer: nothing changed
};

/// A decision, with all that led to it.
struct ActivePlan {
  ActiveStatus status = ActiveStatus::invalid;
  std::optional<Viewpoint> goal;  ///< while flying
  std::vector<int> tour;          ///< ids of the pending targets in their order, the goal's first
  double tour_length_m = 0;       ///< straight lines, with the way home
  std::vector<ViewpointCandidate> candidates;  ///< for the goal's target
  std::optional<Expectation> expected;         ///< of the goal, where the policy has a model
  std::vector<Expectation> flown;  ///< viewpoints that were seen from since the last decision
  int pending = 0, done = 0, visited = 0, unreachable = 0;
  double seen_share = NAN;  ///< of the geofence, where it is swept
};

}  // namespace saker::active
