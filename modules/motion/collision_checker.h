#pragma once

#include <span>

#include "saker/core/config.h"
#include "saker/core/se3.h"
#include "saker/motion/clearance.h"
#include "saker/motion/trajectory.h"
#include "saker/motion/verdict.h"
#include "saker/occupancy/occupancy.h"

namespace saker::motion {

struct CollisionCheckerConfig {
  occupancy::OccupancyConfig map;
  VerdictConfig verdict;
  double stale_after_s = 0.5;
  double farthest_m = 40;
  double block_half_extent_m = 20;
  double block_half_height_m = 6;

  template <class Visitor>
  void visit(Visitor& v) {
    v.group("map", map, "the octree");
    v.group("verdict", verdict, "how trajectories are looked at");
    v.field("stale_after_s", stale_after_s, {0.1, 10}, "s",
            "age of the last scan from which on no trajectory is clear: five scans");
    v.field("farthest_m", farthest_m, {5, 100}, "m",
            "along an axis from the vehicle: beyond it a trajectory is not cleared; bounds the "
            "memory of a verdict");
    v.field("block_half_extent_m", block_half_extent_m, {2, 50}, "m",
            "of the published block along x and y");
    v.field("block_half_height_m", block_half_height_m, {1, 50}, "m", "the same along z");
  }
};

enum class TrajectoryStatus {
  ok,
  malformed,  ///< empty, a number that is not finite, a step that is not positive; the last one
              ///< stays
  outdated,   ///< its id is lower than that of the last one, which stays
};

[[nodiscard]] const char* to_string(TrajectoryStatus status);

/// The collision checker: reads registered scans (from odometry) and the committed trajectory,
/// makes the verdict on it (for guidance) and blocks of the map (for planning). It alone writes
/// occupancy.
///
/// Frames: all in `odom`. Each verdict and block holds all scans integrated before. Cost: see
/// README.md of occupancy and motion. One thread; no clock: `now` is the caller's, of the sensor.
class CollisionChecker {
 public:
  /// Throws Error on an invalid value.
  CollisionChecker(const CollisionCheckerConfig& config, const ClearanceConfig& clearance);

  /// \param points m, lidar frame at `stamp`; what is not finite is skipped, what is beyond the
  ///               map's range clears up to it
  occupancy::InsertReport integrate(Time stamp, const SE3& T_odom_lidar,
                                    std::span<const Eigen::Vector3f> points);

  [[nodiscard]] TrajectoryStatus set_trajectory(Trajectory trajectory);

  /// Not clear before the first scan, when the last one is stale, and without a trajectory.
  [[nodiscard]] Verdict verdict(Time now) const;

  /// The block around the vehicle; empty before the first scan.
  [[nodiscard]] occupancy::OccupancyGrid grid() const;

  [[nodiscard]] const occupancy::OccupancyMap& map() const { return map_; }
  [[nodiscard]] const Trajectory& trajectory() const { return trajectory_; }

 private:
  [[nodiscard]] occupancy::OccupancyGrid block_around(const Trajectory& trajectory, Time now) const;

  CollisionCheckerConfig config_;
  ClearanceConfig clearance_;
  occupancy::OccupancyMap map_;
  Trajectory trajectory_;
  Eigen::Vector3d vehicle_ = Eigen::Vector3d::Constant(NAN);  // the lidar at the last scan
};

}  // namespace saker::motion
