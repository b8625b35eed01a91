#include "saker/odometry/voxel_filter.h"

namespace saker::odometry {

void VoxelFilter::offer(const Eigen::Vector3f& point, std::uint32_t i, double voxels_per_m,
                        std::vector<std::uint32_t>& kept) {
  const VoxelKey key = voxel_key(voxel_cell(point.cast<double>(), voxels_per_m));
  if (index_.find_or_insert(key, i) == i) kept.push_back(i);
}

void VoxelFilter::thin(std::span<const Eigen::Vector3f> points, double voxel_m, double min_range_m,
                       double max_range_m, std::vector<std::uint32_t>& kept) {
  index_.clear();
  kept.clear();
  const auto low = static_cast<float>(min_range_m * min_range_m);
  const auto high = static_cast<float>(max_range_m * max_range_m);
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const float range2 = points[i].squaredNorm();
    if (range2 >= low && range2 <= high) offer(points[i], i, 1 / voxel_m, kept);  // false for NaN
  }
}

void VoxelFilter::thin(std::span<const Eigen::Vector3f> points,
                       std::span<const std::uint32_t> chosen, double voxel_m,
                       std::vector<std::uint32_t>& kept) {
  index_.clear();
  kept.clear();
  for (const std::uint32_t i : chosen) offer(points[i], i, 1 / voxel_m, kept);
}

}  // namespace saker::odometry
