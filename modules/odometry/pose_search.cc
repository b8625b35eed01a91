#include "saker/odometry/pose_search.h"

#include <algorithm>
#include <cmath>

namespace saker::odometry {
namespace {

/// sd along x, y, z of `odom` and about its z.
Eigen::Vector4d spread(const PosePrior& prior) {
  const Eigen::Matrix3d R = prior.T_odom_lidar.linear();
  const Eigen::Matrix3d turn = R * prior.covariance.topLeftCorner<3, 3>() * R.transpose();
  const Eigen::Matrix3d place = R * prior.covariance.bottomRightCorner<3, 3>() * R.transpose();
  return Eigen::Vector4d(place(0, 0), place(1, 1), place(2, 2), turn(2, 2)).cwiseMax(0).cwiseSqrt();
}

SE3 moved(const SE3& T, const Eigen::Vector4d& by) {
  SE3 result = T;
  result.linear() = Eigen::AngleAxisd(by[3], Eigen::Vector3d::UnitZ()) * T.linear();
  result.translation() += by.head<3>();
  return result;
}

struct Scored {
  int score = 0;
  Eigen::Vector4i at = Eigen::Vector4i::Zero();
};

}  // namespace

bool PoseSearch::worthwhile(const PosePrior& prior) const {
  const Eigen::Vector4d sd = config_.reach_sd * spread(prior);
  return sd.head<3>().maxCoeff() > config_.step_m || sd[3] > config_.step_rad;
}

bool PoseSearch::covers(const PosePrior& prior) const {
  const Eigen::Vector4d reach = config_.reach_sd * spread(prior);
  return reach.head<2>().maxCoeff() <= config_.most_m && reach[3] <= config_.most_rad;
}

PoseSearch::Grid PoseSearch::grid_over(const PosePrior& prior) const {
  Eigen::Vector4d reach = config_.reach_sd * spread(prior);
  reach.head<3>() = reach.head<3>().cwiseMin(config_.most_m);
  reach[3] = std::min(reach[3], config_.most_rad);
  Grid grid;
  if (!reach.allFinite()) return grid;
  grid.step << config_.step_m, config_.step_m, config_.step_m, config_.step_rad;
  for (;; grid.step *= 1.2) {
    grid.half = (reach.array() / grid.step.array()).round().cast<int>();
    if ((2 * grid.half.cast<double>().array() + 1).prod() <= config_.most_poses) return grid;
  }
}

int PoseSearch::score(std::span<const Eigen::Vector3d> points, const SE3& T, VoxelMap& map,
                      std::size_t stride) const {
  int on_plane = 0;
  for (std::size_t i = 0; i < points.size(); i += stride) {
    const Eigen::Vector3d p = T * points[i];
    const auto plane = map.nearest_plane(p, false);
    on_plane += plane && std::abs(plane->normal.dot(p - plane->point)) < config_.on_plane_m;
  }
  return on_plane;
}

std::vector<SE3> PoseSearch::starts(std::span<const Eigen::Vector3d> points, const PosePrior& prior,
                                    VoxelMap& map) const {
  const Grid grid = grid_over(prior);
  const std::size_t stride =
      std::max<std::size_t>(1, points.size() / static_cast<std::size_t>(config_.points));
  std::vector<Scored> tried;
  Eigen::Vector4i at;
  for (at[0] = -grid.half[0]; at[0] <= grid.half[0]; ++at[0])
    for (at[1] = -grid.half[1]; at[1] <= grid.half[1]; ++at[1])
      for (at[2] = -grid.half[2]; at[2] <= grid.half[2]; ++at[2])
        for (at[3] = -grid.half[3]; at[3] <= grid.half[3]; ++at[3]) {
          if (at.isZero()) continue;
          const Eigen::Vector4d by = at.cast<double>().cwiseProduct(grid.step);
          tried.push_back({score(points, moved(prior.T_odom_lidar, by), map, stride), at});
        }
  std::stable_sort(tried.begin(), tried.end(),
                   [](const Scored& a, const Scored& b) { return a.score > b.score; });
  std::vector<SE3> best;
  std::vector<Eigen::Vector4i> taken;
  for (const Scored& pose : tried) {
    if (best.size() >= static_cast<std::size_t>(config_.kept)) break;
    const bool near = std::any_of(taken.begin(), taken.end(), [&](const Eigen::Vector4i& other) {
      return (other - pose.at).cwiseAbs().maxCoeff() <= 1;
    });
    if (near) continue;
    taken.push_back(pose.at);
    best.push_back(moved(prior.T_odom_lidar, pose.at.cast<double>().cwiseProduct(grid.step)));
  }
  return best;
}

}  // namespace saker::odometry
