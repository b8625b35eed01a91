#pragma once

#include <functional>
#include <string>
#include <vector>

#include "saker/active/views/field_of_view.h"
#include "saker/active/views/occupancy_view.h"
#include "saker/core/config.h"
#include "saker/core/se3.h"
#include "saker/objects/models.h"

/// Viewpoints of a target.
///
/// Reads a target's extent, the field of view and the occupancy block, makes rings of candidates
/// around it, from the nearest place that has all of it in view, each with the first reason that
/// speaks against it. Frames: viewpoints and targets are in `world`, the occupancy block is in
/// `odom`. Cost: 72 candidates of five rays each.
namespace saker::active {

/// Whether the vehicle may be there; `world`.
using InGeofence = std::function<bool(const Eigen::Vector3d&)>;

/// The place, or one over it, clear of the fence's floor, where it lies below that (where the
/// ground falls away from the take-off); as it is where it had to be raised by more than `most_m`.
[[nodiscard]] Eigen::Vector3d raised_into(const InGeofence& in_geofence,
                                          const Eigen::Vector3d& place, double most_m);

/// Of a frame that stands upright at `position`, turned by `yaw`, rad.
[[nodiscard]] inline SE3 level_pose(const Eigen::Vector3d& position, double yaw) {
  SE3 T = SE3::Identity();
  T.linear() = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  T.translation() = position;
  return T;
}

/// A place to fly to, and a heading there.
struct Viewpoint {
  int id = -1;  ///< target and slot: the same direction and ring have the same id; below −1: a stop
                ///< of the sweep
  int target_id = -1;  ///< of the prior map's object; −1: none, a stop of the sweep
  Eigen::Vector3d position = Eigen::Vector3d::Constant(NAN);  ///< world, m
  double yaw = NAN;                                           ///< rad, so that it sees the target
  double bearing = NAN;  ///< rad, world: from the target to the viewpoint

  /// T_world_body there, level.
  [[nodiscard]] SE3 pose() const { return level_pose(position, yaw); }
};

/// Why a candidate is not flown to.
enum class Refusal {
  none,
  out_of_view,       ///< the target is not all in the field of view from there
  outside_geofence,  ///<
  occupied,          ///< something is nearer than the clearance
  hidden,            ///< too little of the target is visible
  seen,              ///< too near to a side that was seen
  motion,            ///< motion planning found no way, or the vehicle came no nearer
  enclosed,          ///< cut off from the vehicle by what is occupied
  drift,             ///< the pose will have drifted too far since the target was first seen
  region,            ///< outside of the region of good views, or no sample of it
};

[[nodiscard]] inline const char* to_string(Refusal refusal) {
  constexpr const char* kNames[] = {"none",
                                    "out of view",
                                    "outside the geofence",
                                    "occupied",
                                    "hidden",
                                    "seen",
                                    "no way there",
                                    "enclosed",
                                    "too late",
                                    "outside the region"};
  return kNames[static_cast<int>(refusal)];
}

struct ViewpointCandidate {
  Viewpoint viewpoint;
  bool known_free = false;  ///< else it was never seen, and may be once the vehicle is nearer
  double gain = 0;          ///< what a view from there brings; its unit is the policy's
  double cost_m = 0;        ///< flight that it takes
  Refusal refusal = Refusal::none;
};

struct ViewpointConfig {
  double height_m = 3.0;
  int bearings = 24;
  int rings = 3;
  double ring_step_m = 1.5;
  double clearance_m = 0.9;
  double least_visible = 0.6;
  double own_margin_m = 0.5;

  template <class Visitor>
  void visit(Visitor& v) {
    v.setting("height_m", height_m, {0.3, 50}, "m",
              "Viewpoints are so high over the ground under the target, within the geofence: over "
              "vehicles, under most crowns.");
    v.field("bearings", bearings, {4, 72}, "", "directions around the target");
    v.field("rings", rings, {1, 10}, "", "distances, from the nearest that has it all in view");
    v.field("ring_step_m", ring_step_m, {0.25, 10}, "m", "between them");
    v.field("clearance_m", clearance_m, {0.1, 5}, "m",
            "to what is occupied: more than motion planning asks for, which must get there");
    v.field("least_visible", least_visible, {0, 1}, "", "share of the target that must be visible");
    v.field("own_margin_m", own_margin_m, {0, 3}, "m",
            "cells so near to the target are its own: its error and a cell's diagonal");
  }
};

/// Rings of candidates around a target, each with the first refusal that applies; ids from
/// `first_id` on, bearings · rings of them.
[[nodiscard]] std::vector<ViewpointCandidate> sample_viewpoints(
    const objects::Cuboid& target, int first_id, const ViewpointConfig& config,
    const FieldOfViewConfig& view, const OccupancyView& block, const InGeofence& in_geofence);

/// The first of the refusals that hold whatever was seen so far.
[[nodiscard]] Refusal refusal_of(const Viewpoint& viewpoint, const objects::Cuboid& target,
                                 const ViewpointConfig& config, const FieldOfViewConfig& view,
                                 const OccupancyView& block, const InGeofence& in_geofence);

}  // namespace saker::active
