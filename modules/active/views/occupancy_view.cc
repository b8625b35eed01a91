#include "saker/active/views/occupancy_view.h"

#include <algorithm>
#include <vector>

namespace saker::active {
namespace {

using objects::Cuboid;

constexpr double kRayHeight = 0.6;  // of the target: clear of the ground's cells
constexpr double kRayEdge = 0.9;    // of half the size: on the target, not beside it

bool within(const Eigen::Vector3d& in_target, const Cuboid& target, double margin) {
  return (in_target.cwiseAbs() - 0.5 * target.size).maxCoeff() <= margin;
}

/// The target's middle and its four vertical edges, in its own frame.
std::vector<Eigen::Vector3d> visibility_points(const Cuboid& target) {
  const Eigen::Vector3d half = 0.5 * target.size;
  const double z = (2 * kRayHeight - 1) * half.z();
  std::vector<Eigen::Vector3d> points = {{0, 0, z}};
  for (const double x : {-kRayEdge, kRayEdge}) {
    for (const double y : {-kRayEdge, kRayEdge}) points.emplace_back(x * half.x(), y * half.y(), z);
  }
  return points;
}

/// Whether an occupied cell lies on the way from `eye` up to where the target begins.
bool hidden(const Eigen::Vector3d& eye, const Eigen::Vector3d& point_in_target,
            const Cuboid& target, const OccupancyView& block, double own_margin_m) {
  const Eigen::Vector3d eye_in_target = target.pose.inverse() * eye;
  const Eigen::Vector3d ray = point_in_target - eye_in_target;
  const int steps = static_cast<int>(2 * ray.norm() / block.grid->resolution_m) + 1;
  for (int step = 0; step < steps; ++step) {
    const Eigen::Vector3d p = eye_in_target + ray * step / steps;
    if (within(p, target, own_margin_m)) return false;
    if (block.at(target.pose * p) == occupancy::Cell::occupied) return true;
  }
  return false;
}

}  // namespace

bool OccupancyView::blocked(const Eigen::Vector3d& p_world, double radius) const {
  if (!grid) return false;
  const Eigen::Vector3d p = T_odom_world * p_world;
  const Eigen::Array3d reach = Eigen::Array3d::Constant(radius);
  const Eigen::Vector3i low = grid->index_of(p.array() - reach).cwiseMax(0);
  const Eigen::Vector3i high =
      grid->index_of(p.array() + reach).cwiseMin((grid->size.array() - 1).matrix());
  for (int z = low.z(); z <= high.z(); ++z) {
    for (int y = low.y(); y <= high.y(); ++y) {
      for (int x = low.x(); x <= high.x(); ++x) {
        const Eigen::Vector3i cell(x, y, z);
        if (grid->cells[grid->offset(cell)] == occupancy::Cell::occupied &&
            (grid->centre_of(cell) - p).norm() <= radius) {
          return true;
        }
      }
    }
  }
  return false;
}

double visible_share(const Eigen::Vector3d& eye, const Cuboid& target, const OccupancyView& block,
                     double own_margin_m) {
  if (!block.grid) return 1;
  const std::vector<Eigen::Vector3d> points = visibility_points(target);
  const auto visible = std::count_if(points.begin(), points.end(), [&](const auto& point) {
    return !hidden(eye, point, target, block, own_margin_m);
  });
  return static_cast<double>(visible) / static_cast<double>(points.size());
}

}  // namespace saker::active
