#pragma once

#include <Eigen/Core>
#include <cmath>

#include "saker/core/config.h"

namespace saker::motion {

/// How far from everything the vehicle stays, and where what was never seen counts as free. The
/// planner and the collision checker's verdict share it.
struct ClearanceConfig {
  double robot_radius_m = 0.4;
  double margin_m = 0.25;
  double planning_slack_m = 0.1;
  double takeoff_radius_m = 2.5;
  double takeoff_height_m = 8;
  double vehicle_ball_m = 1.5;

  template <class Visitor>
  void visit(Visitor& v) {
    v.setting("robot_radius_m", robot_radius_m, {0.05, 2}, "m",
              "A ball of this radius around the body's centre holds frame and propellers.");
    v.setting("margin_m", margin_m, {0, 10}, "m",
              "The ball keeps this far from what is occupied or unknown.");
    v.field("planning_slack_m", planning_slack_m, {0, 1}, "m",
            "more than that when a path is planned, so that noise in the map does not stop it");
    v.setting("takeoff_radius_m", takeoff_radius_m, {0, 10}, "m",
              "Unknown space counts as free in an upright column of this radius over the take-off "
              "point.");
    v.setting("takeoff_height_m", takeoff_height_m, {0, 50}, "m", "That column is so high.");
    v.field("vehicle_ball_m", vehicle_ball_m, {0, 10}, "m",
            "around the vehicle the unknown is free: it is there, and sees nothing so near");
  }

  /// m, from the body's centre, kept by planner and collision checker.
  [[nodiscard]] double least_m() const { return robot_radius_m + margin_m; }

  /// m, kept on the way out from a cell whose surface is `now_m` from the body's centre already:
  /// the radius, or what there is of it. A cell that was seen late, and is larger than what is in
  /// it, may be that near; the vehicle leaves it without coming nearer. In touch there is no way.
  [[nodiscard]] double leaving_m(double now_m) const {
    return now_m > kAsNear_m && now_m < robot_radius_m ? now_m - kAsNear_m : robot_radius_m;
  }
  static constexpr double kAsNear_m = 0.02;  ///< the same distance: a smoothed path cuts corners
};

/// Where what was never seen counts as free, all the same: places that the vehicle stands for.
struct Exemption {
  Eigen::Vector3d takeoff = Eigen::Vector3d::Constant(NAN);  ///< foot of the column; NaN: none
  Eigen::Vector3d vehicle = Eigen::Vector3d::Constant(NAN);  ///< centre of the ball; NaN: none

  [[nodiscard]] bool contains(const Eigen::Vector3d& p, const ClearanceConfig& config) const {
    const Eigen::Vector3d from_foot = p - takeoff;
    const bool in_column = from_foot.head<2>().norm() <= config.takeoff_radius_m &&
                           from_foot.z() >= 0 && from_foot.z() <= config.takeoff_height_m;
    return in_column || (p - vehicle).norm() <= config.vehicle_ball_m;
  }
};

}  // namespace saker::motion
