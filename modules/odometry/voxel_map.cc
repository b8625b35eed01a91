#include "saker/odometry/voxel_map.h"

#include <Eigen/Eigenvalues>
#include <algorithm>

namespace saker::odometry {

VoxelMap::VoxelMap(const VoxelMapConfig& config)
    : config_(config), index_(static_cast<std::size_t>(config.max_voxels)) {
  voxels_.reserve(static_cast<std::size_t>(config.max_voxels));
  ages_.reserve(static_cast<std::size_t>(config.max_voxels));
}

void VoxelMap::clear() {
  index_.clear();
  voxels_.clear();
}

void VoxelMap::insert(std::span<const Eigen::Vector3d> points, Time stamp) {
  const double voxels_per_m = 1 / config_.voxel_m;
  for (const Eigen::Vector3d& point : points) {
    const Eigen::Vector3i cell = voxel_cell(point, voxels_per_m);
    const VoxelKey key = voxel_key(cell);
    const std::uint32_t at = index_.find_or_insert(key, static_cast<std::uint32_t>(voxels_.size()));
    if (at == VoxelIndex::kNone) continue;  // full until the next prune
    if (at == voxels_.size()) {
      Voxel& fresh = voxels_.emplace_back();
      fresh.key = key;
      fresh.first_seen = stamp;
      fresh.corner = cell.cast<double>() * config_.voxel_m;
    }
    Voxel& voxel = voxels_[at];
    voxel.last_seen = stamp;
    if (voxel.count >= config_.max_points) continue;
    const Eigen::Vector3f local = (point - voxel.corner).cast<float>();
    voxel.sum += local;
    voxel.products += local * local.transpose();
    ++voxel.count;
    voxel.shape = Shape::unknown;
  }
}

void VoxelMap::fit(Voxel& voxel) const {
  voxel.shape = Shape::other;
  if (voxel.count < config_.min_points) return;
  const Eigen::Vector3d mean = voxel.sum.cast<double>() / voxel.count;
  const Eigen::Matrix3d covariance =
      voxel.products.cast<double>() / voxel.count - mean * mean.transpose();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(covariance);
  const Eigen::Vector3d& variance = solver.eigenvalues();
  const auto square = [](double x) { return x * x; };
  if (variance[0] > square(config_.max_thickness_m) ||
      variance[1] < square(config_.min_breadth_m) || variance[1] < 16 * variance[0])
    return;
  voxel.shape = Shape::plane;
  voxel.mean = mean.cast<float>();
  voxel.normal = solver.eigenvectors().col(0).cast<float>();
  voxel.variance = static_cast<float>(std::max(variance[0], 0.0));
  for (int i = 0; i < 2; ++i) {
    const double spread = std::sqrt(variance[i + 1] * voxel.count);
    voxel.tilt.col(i) = (solver.eigenvectors().col(i + 1) / spread).cast<float>();
  }
}

VoxelMap::Voxel* VoxelMap::plane_at(const Eigen::Vector3i& cell) {
  const std::uint32_t at = index_.find(voxel_key(cell));
  if (at == VoxelIndex::kNone) return nullptr;
  Voxel& voxel = voxels_[at];
  if (voxel.shape == Shape::unknown) fit(voxel);
  return voxel.shape == Shape::plane ? &voxel : nullptr;
}

std::optional<Plane> VoxelMap::nearest_plane(const Eigen::Vector3d& point, bool wide) {
  const auto plane = [](const Voxel& v) {
    return Plane{v.corner + v.mean.cast<double>(), v.normal.cast<double>(), v.variance,
                 v.first_seen, v.tilt.cast<double>()};
  };
  const Eigen::Vector3i own = voxel_cell(point, 1 / config_.voxel_m);
  if (const Voxel* voxel = plane_at(own)) return plane(*voxel);
  if (!wide) return std::nullopt;

  const Voxel* best = nullptr;
  double best_distance2 = std::numeric_limits<double>::infinity();
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z) {
        const Voxel* voxel = plane_at(own + Eigen::Vector3i(x, y, z));
        if (!voxel) continue;
        const double distance2 = (voxel->corner + voxel->mean.cast<double>() - point).squaredNorm();
        if (distance2 >= best_distance2) continue;
        best = voxel;
        best_distance2 = distance2;
      }
  if (!best) return std::nullopt;
  return plane(*best);
}

Time VoxelMap::oldest_to_keep() const {
  const auto most = static_cast<std::size_t>(
      0.9 * config_.max_voxels);  // room for the scans until the next prune
  if (voxels_.size() <= most) return std::numeric_limits<Time>::min();
  ages_.clear();
  for (const Voxel& voxel : voxels_) ages_.push_back(voxel.last_seen);
  const auto cut = ages_.begin() + static_cast<std::ptrdiff_t>(ages_.size() - most);
  std::nth_element(ages_.begin(), cut, ages_.end());
  return *cut;
}

void VoxelMap::prune(const Eigen::Vector3d& centre, Time now) {
  const Time oldest = std::max(oldest_to_keep(), now - from_seconds(config_.max_age_s));
  const double reach2 = config_.max_distance_m * config_.max_distance_m;
  std::erase_if(voxels_, [&](const Voxel& voxel) {
    return voxel.last_seen < oldest || (voxel.corner - centre).squaredNorm() > reach2;
  });
  index_.clear();
  for (std::uint32_t i = 0; i < voxels_.size(); ++i) index_.find_or_insert(voxels_[i].key, i);
}

}  // namespace saker::odometry
