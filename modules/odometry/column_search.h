#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "saker/core/config.h"
#include "saker/odometry/registration.h"
#include "saker/odometry/voxel_map.h"

namespace saker::odometry {

struct ColumnSearchConfig {
  double most_m = 60;
  double reach_sd = 2.5;
  double height_m = 1;
  int columns = 250;
  int most_scored = 100000;
  int kept = 5;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("most_m", most_m, {1, 200}, "m", "never farther from the prediction");
    v.field("reach_sd", reach_sd, {1, 6}, "", "of the prediction, so far around it is searched");
    v.field("height_m", height_m, {0.3, 10}, "m", "of what makes a column: higher than kerbs");
    v.field("columns", columns, {20, 5000}, "", "of the scan that are looked up, at most");
    v.field("most_scored", most_scored, {100, 1e7}, "",
            "windows of places that are scored; more, and nothing is found: another may be better");
    v.field("kept", kept, {1, 50}, "", "best poses from which registration starts");
  }
};

/// Where in the whole local map a scan may have been taken, when the prediction leaves tens of
/// metres or any heading open: place and heading in the horizontal, by the columns (walls, trunks,
/// poles) of scan and map, which tilt and height hardly change. Branch and bound over windows of
/// places: Hess et al., "Real-Time Loop Closure in 2D LIDAR SLAM" (ICRA 2016), sec. V, best first.
///
/// Frames: points in the lidar's, poses in `odom`, of which z is up. Cost: windows × columns
/// look-ups in a grid, at most most_scored × columns; 10 to 50 ms in a street.
class ColumnSearch {
 public:
  explicit ColumnSearch(const ColumnSearchConfig& config) : config_(config) {}

  /// Best first, columns apart; roll, pitch and height are the prior's. None where there are too
  /// many to look at.
  [[nodiscard]] std::vector<SE3> starts(std::span<const Eigen::Vector3d> points,
                                        const PosePrior& prior, const VoxelMap& map) const;

 private:
  ColumnSearchConfig config_;
};

}  // namespace saker::odometry
