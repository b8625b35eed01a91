#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "saker/core/budget.h"
#include "saker/motion/clearance.h"
#include "saker/motion/geofence.h"
#include "saker/motion/limits.h"
#include "saker/motion/search.h"
#include "saker/motion/trajectory.h"
#include "saker/occupancy/grid.h"

/// Motion planning: reads one occupancy snapshot and a goal, makes a collision-free timed
/// trajectory that ends at rest (for guidance and the collision checker).
///
/// All is in `odom`. What was never seen is not free, but for the take-off column and a ball around
/// the vehicle (clearance.h). In order, as `plan` reads:
///  1. a distance field over the snapshot (free_space.h);
///  2. where to: the goal, or the reachable point from which the way on through what may be free is
///     shortest (destination.h);
///  3. a path: straight if that is free, else RRT-Connect (Kuffner & LaValle, ICRA 2000; OMPL) with
///     shortcuts (search.h), corners rounded by arcs (curve.h);
///  4. speeds along it by a backward and a forward pass (Bobrow, Dubowsky & Gibson, IJRR 1985),
///     averaged over a short window, which bounds the jerk (retiming.h);
///  5. the result is checked against the field every 5 cm, and against the limits.
/// A start in motion first flies straight on, as far as it needs to stop; what follows is planned
/// from there, and the corner is rounded as widely as the speed allows: position, velocity and
/// acceleration have no jump, and a goal behind it is reached by braking first.
///
/// Cost: 35 ms for 40 × 40 × 10 m at 0.25 m. The same inputs give the same bytes.
namespace saker::motion {

struct MotionConfig {
  LimitsConfig limits;
  ClearanceConfig clearance;
  GeofenceConfig geofence;
  SearchConfig search;

  template <class Visitor>
  void visit(Visitor& v) {
    v.group("limits", limits, "what a trajectory may ask of the vehicle");
    v.group("clearance", clearance, "how far it stays from everything");
    v.group("geofence", geofence, "where it may fly");
    v.group("search", search, "how paths are looked for");
  }
};

struct PlanRequest {
  MotionState start;    ///< on the committed trajectory, or where the vehicle rests
  Time start_time = 0;  ///< when it is there
  Eigen::Vector3d goal = Eigen::Vector3d::Constant(NAN);  ///< m
  std::optional<double> goal_yaw;                         ///< rad; without: as it arrives
  std::shared_ptr<const occupancy::OccupancyGrid> grid;
  Eigen::Vector3d takeoff = Eigen::Vector3d::Constant(NAN);  ///< foot of the column; NaN: none
  std::int64_t trajectory_id = 0;                            ///< of the result
  std::uint64_t seed = 0;                                    ///< another one, another search
};

enum class PlanStatus {
  ok,
  bad_request,    ///< a number that is not finite, no snapshot, or a state beyond the limits
  start_blocked,  ///< in an occupied cell, or it cannot brake straight on
  goal_outside,   ///< the goal is outside of the geofence
  goal_blocked,   ///< the goal is in an obstacle, nothing free near it
  no_path,        ///< obstacles and geofence enclose the start or the goal
  no_progress,    ///< nothing known to be free lies nearer to the goal than the start
  out_of_time,    ///< the budget ended first
  unsafe_result,  ///< the final check refused it
};

[[nodiscard]] const char* to_string(PlanStatus status);

struct PlanDiagnostics {
  bool straight = false;     ///< no search was needed
  int iterations = 0;        ///< of RRT-Connect
  double path_m = NAN;       ///< length of the curve
  double duration_s = NAN;   ///< of the trajectory
  double clearance_m = NAN;  ///< least distance of the trajectory to what is not free
};

struct PlanResult {
  PlanStatus status = PlanStatus::bad_request;
  std::string reason;     ///< one line; empty when ok
  bool partial = false;   ///< it ends on the way to the goal, where the known free space does
  Trajectory trajectory;  ///< empty unless ok
  PlanDiagnostics diagnostics;
};

class MotionPlanner {
 public:
  explicit MotionPlanner(const MotionConfig& config);  ///< throws Error on an invalid value

  /// Never throws; keeps nothing from one call to the next.
  /// \param budget  iterations of RRT-Connect in all, and the deadline, obeyed within the time of
  ///                a distance field or two (10 ms).
  [[nodiscard]] PlanResult plan(const PlanRequest& request, const core::Budget& budget) const;

  [[nodiscard]] const MotionConfig& config() const { return config_; }
  [[nodiscard]] const Geofence& geofence() const { return geofence_; }

 private:
  MotionConfig config_;
  Geofence geofence_;
};

}  // namespace saker::motion
