#pragma once

#include <span>
#include <vector>

#include "saker/odometry/voxel_index.h"

namespace saker::odometry {

/// Thins a cloud: of the points in a voxel the first one is kept. Points that are not finite, or
/// out of the range, are left out. Indices into the cloud come out, in its order, at most
/// `most_voxels` of them.
class VoxelFilter {
 public:
  explicit VoxelFilter(std::size_t most_voxels) : index_(most_voxels) {}

  void thin(std::span<const Eigen::Vector3f> points, double voxel_m, double min_range_m,
            double max_range_m, std::vector<std::uint32_t>& kept);

  /// The same of those points of a cloud that `chosen` names; their range has been looked at
  /// before.
  void thin(std::span<const Eigen::Vector3f> points, std::span<const std::uint32_t> chosen,
            double voxel_m, std::vector<std::uint32_t>& kept);

 private:
  void offer(const Eigen::Vector3f& point, std::uint32_t i, double voxels_per_m,
             std::vector<std::uint32_t>& kept);

  VoxelIndex index_;
};

}  // namespace saker::odometry
