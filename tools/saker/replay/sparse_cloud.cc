#include "tools/saker/replay/sparse_cloud.h"

#include <algorithm>

namespace saker::tools {

void SparseCloud::reserve(std::size_t scans) {
  points_.reserve(std::min(kMostPoints, scans * 2 * per_scan_));
}

void SparseCloud::add(std::span<const Eigen::Vector3f> points) {
  const std::size_t stride = std::max<std::size_t>(points.size() / per_scan_, 1);
  for (std::size_t i = 0; i < points.size() && points_.size() < kMostPoints; i += stride) {
    if (points[i].allFinite()) points_.push_back({scans_, points[i]});
  }
  ++scans_;
}

std::vector<Eigen::Vector3d> SparseCloud::in_world(const std::vector<SE3>& T_world_lidar) const {
  std::vector<Eigen::Vector3d> points;
  points.reserve(points_.size());
  for (const Point& p : points_) {
    if (p.scan >= T_world_lidar.size()) break;
    points.emplace_back(T_world_lidar[p.scan] * p.in_lidar.cast<double>());
  }
  return points;
}

std::vector<autonomy::RegisteredScan> SparseCloud::scans(
    std::span<const Time> stamps, const std::vector<SE3>& T_world_lidar) const {
  std::vector<autonomy::RegisteredScan> scans;
  const std::size_t known = std::min(stamps.size(), T_world_lidar.size());
  for (std::size_t i = 0; i < points_.size() && points_[i].scan < known;) {
    const std::uint32_t scan = points_[i].scan;
    std::vector<Eigen::Vector3f> points;
    for (; i < points_.size() && points_[i].scan == scan; ++i)
      points.push_back(points_[i].in_lidar);
    scans.push_back(
        {.stamp = stamps[scan],
         .T_odom_lidar = T_world_lidar[scan],
         .points = std::make_shared<const std::vector<Eigen::Vector3f>>(std::move(points))});
  }
  return scans;
}

}  // namespace saker::tools
