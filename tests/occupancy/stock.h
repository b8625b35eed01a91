#pragma once

#include <octomap/octomap.h>

#include <span>

#include "saker/occupancy/occupancy.h"

/// OctoMap's own insertion, to compare with.
namespace saker::made {

inline void configure(octomap::OcTree& tree, const occupancy::OccupancyConfig& config) {
  tree.setProbHit(config.hit_probability);
  tree.setProbMiss(config.miss_probability);
  tree.setClampingThresMin(config.lowest_probability);
  tree.setClampingThresMax(config.highest_probability);
}

/// Points in the lidar's frame; those that are not finite, and the vehicle's own, are taken out
/// first.
inline void insert(octomap::OcTree& tree, const occupancy::OccupancyConfig& config,
                   std::span<const Eigen::Vector3f> points, const SE3& T_odom_lidar) {
  const Eigen::Isometry3f T = T_odom_lidar.cast<float>();
  octomap::Pointcloud cloud;
  for (const Eigen::Vector3f& point : points) {
    if (!point.allFinite() || point.squaredNorm() < config.body_radius_m * config.body_radius_m)
      continue;
    const Eigen::Vector3f p = T * point;
    cloud.push_back(p.x(), p.y(), p.z());
  }
  const Eigen::Vector3f origin = T.translation();
  tree.insertPointCloud(cloud, octomap::point3d(origin.x(), origin.y(), origin.z()), config.range_m,
                        false, false);
}

}  // namespace saker::made
