#pragma once

#include <span>
#include <vector>

#include "saker/core/config.h"
#include "saker/core/se3.h"
#include "saker/occupancy/grid.h"
#include "saker/occupancy/map_tree.h"
#include "saker/occupancy/scan_box.h"

namespace saker::occupancy {

/// What was hit for long is free again after (log-odds high − 0) / miss = 2.20 / 0.41 → 6 scans
/// that see through it; what was free for long is occupied after one hit: −0.80 + 0.85 ≥ 0.
struct OccupancyConfig {
  double resolution_m = 0.25;
  double range_m = 15;
  double body_radius_m = 0.5;
  double hit_probability = 0.7;
  double miss_probability = 0.4;
  double lowest_probability = 0.31;
  double highest_probability = 0.9;
  double keep_radius_m = 60;
  double drop_every_s = 2;
  int max_nodes = 2000000;

  template <class Visitor>
  void visit(Visitor& v) {
    v.setting("resolution_m", resolution_m, {0.05, 1}, "m",
              "A cell of the occupancy map has edges of this length.");
    v.setting("range_m", range_m, {1, 50}, "m",
              "Points farther away clear space only up to here; cost grows with its cube.");
    v.setting("body_radius_m", body_radius_m, {0, 5}, "m",
              "Points nearer to the sensor are taken for the vehicle's own.");
    v.field("hit_probability", hit_probability, {0.5, 0.97}, "",
            "of being occupied, of a cell with a point in it");
    v.field("miss_probability", miss_probability, {0.03, 0.5}, "",
            "of being occupied, of a cell that a ray went through");
    v.field("lowest_probability", lowest_probability, {0.03, 0.5}, "",
            "a cell gets no lower: one hit has to make it occupied");
    v.field("highest_probability", highest_probability, {0.5, 0.97}, "",
            "a cell gets no higher: ten misses have to make it free");
    v.field("keep_radius_m", keep_radius_m, {10, 1000}, "m",
            "what is farther from the sensor is dropped");
    v.field("drop_every_s", drop_every_s, {0, 60}, "s", "how often");
    v.setting("max_nodes", max_nodes, {10000, 5e7}, "",
              "The octree has at most so many nodes of 45 B; beyond, what is far away is dropped.");
  }
};

enum class InsertStatus {
  ok,
  not_newer,  ///< nothing changed
  bad_pose,   ///< not finite, or beyond the octree (8 km at 0.25 m); nothing changed
};

[[nodiscard]] const char* to_string(InsertStatus status);

struct InsertReport {
  InsertStatus status = InsertStatus::ok;
  int points = 0;           ///< that were used
  int own_points = 0;       ///< of the vehicle's body
  std::size_t nodes = 0;    ///< of the octree, afterwards
  std::size_t dropped = 0;  ///< nodes, too far away or beyond the ceiling
};

/// Reads registered scans (from odometry), makes the octree of what is occupied, free and unknown
/// around the vehicle, and dense blocks of it (for motion, active, the collision checker).
///
/// Frame: `odom`. Method: Hornung et al., "OctoMap" (Autonomous Robots 2013), sec. 3, with the same
/// tree as octomap::OcTree::insertPointCloud(cloud, origin, range) makes of the same points, not
/// discretised, not lazy; ScanBox and MapTree say how. Cost: its README. One thread; allocates
/// nothing after warm-up but the octree's nodes.
class OccupancyMap {
 public:
  explicit OccupancyMap(const OccupancyConfig& config);  ///< throws Error on an invalid value

  /// Time order is required. What is not finite is skipped. A beam without a return only clears,
  /// from some range on (open_beam.h).
  /// \param points m, lidar frame at `stamp`
  InsertReport insert(std::span<const Eigen::Vector3f> points, const SE3& T_odom_lidar, Time stamp);

  /// The block from `low` to `high` (m, odom), widened to whole cells, cut at the octree's ends.
  [[nodiscard]] OccupancyGrid block(const Eigen::Vector3d& low, const Eigen::Vector3d& high) const;

  [[nodiscard]] Time stamp() const { return stamp_; }  ///< of the last scan; 0 before the first
  [[nodiscard]] const octomap::OcTree& tree() const { return tree_; }
  [[nodiscard]] const OccupancyConfig& config() const { return config_; }

 private:
  void take(std::span<const Eigen::Vector3f> points, const SE3& T_odom_lidar, InsertReport& report);
  [[nodiscard]] std::size_t drop_far(const Eigen::Vector3d& centre);

  OccupancyConfig config_;
  MapTree tree_;
  ScanBox box_;
  std::vector<ScanBox::Beam> beams_;
  Time stamp_ = 0;
  Time dropped_stamp_ = 0;
};

}  // namespace saker::occupancy
