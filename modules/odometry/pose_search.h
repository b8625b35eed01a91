#pragma once

#include <span>
#include <vector>

#include "saker/core/config.h"
#include "saker/odometry/registration.h"
#include "saker/odometry/voxel_map.h"

namespace saker::odometry {

struct PoseSearchConfig {
  double step_m = 0.4;
  double step_rad = 0.06;
  double reach_sd = 2.5;
  double most_m = 6;
  double most_rad = 0.6;
  double on_plane_m = 0.2;
  int points = 400;
  int most_poses = 3000;
  int kept = 4;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("step_m", step_m, {0.05, 5}, "m",
            "between poses that are tried: registration converges from half of it, a fraction of a "
            "voxel");
    v.field("step_rad", step_rad, {0.005, 1}, "rad", "the same of the heading");
    v.field("reach_sd", reach_sd, {1, 6}, "", "of the prediction, so far around it is searched");
    v.field("most_m", most_m, {0.1, 50}, "m", "never farther");
    v.field("most_rad", most_rad, {0.01, 3.2}, "rad", "nor turned by more");
    v.field("on_plane_m", on_plane_m, {0.01, 1}, "m",
            "a point so near to the plane of its voxel is on it: half a step");
    v.field("points", points, {50, 10000}, "", "about so many points are looked up for each pose");
    v.field("most_poses", most_poses, {10, 100000}, "",
            "that are tried; more, and steps become longer");
    v.field("kept", kept, {1, 50}, "", "best poses from which registration starts");
  }
};

/// Where registration should start when the prediction is not sure enough for one start: poses on a
/// grid over what the prior leaves open (place and heading about the vertical), scored by the share
/// of points on planes of the map. Scan matching by exhaustive search, Olson, "Real-Time
/// Correlative Scan Matching" (ICRA 2009), sec. III, on planes instead of a raster.
///
/// Frames: points in the lidar's, poses in `odom`. Cost: poses × points hash look-ups, 0.05 µs
/// each: bounded by most_poses.
class PoseSearch {
 public:
  explicit PoseSearch(const PoseSearchConfig& config) : config_(config) {}

  /// Best first, at least a step apart; the prior's own pose is not among them.
  [[nodiscard]] std::vector<SE3> starts(std::span<const Eigen::Vector3d> points,
                                        const PosePrior& prior, VoxelMap& map) const;

  /// Whether the prior leaves more open than registration finds from one start.
  [[nodiscard]] bool worthwhile(const PosePrior& prior) const;

  /// Whether all that the prior leaves open is searched.
  [[nodiscard]] bool covers(const PosePrior& prior) const;

 private:
  /// Half widths in steps, and the steps: along x, y, z of `odom` and about z.
  struct Grid {
    Eigen::Vector4i half = Eigen::Vector4i::Zero();
    Eigen::Vector4d step = Eigen::Vector4d::Zero();
  };

  [[nodiscard]] Grid grid_over(const PosePrior& prior) const;
  [[nodiscard]] int score(std::span<const Eigen::Vector3d> points, const SE3& T, VoxelMap& map,
                          std::size_t stride) const;

  PoseSearchConfig config_;
};

}  // namespace saker::odometry
