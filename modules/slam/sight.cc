#include "slam/sight.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

namespace saker::slam {
namespace {

bool in_range(const Landmark& landmark, double distance, const LandmarkConfig& config) {
  return distance <= landmark.farthest &&
         distance >= std::min(landmark.nearest, config.surely_seen_m);
}

}  // namespace

bool in_view(const Landmark& landmark, const Eigen::Vector3d& eye,
             std::span<const Landmark> landmarks, const LandmarkConfig& config) {
  const Eigen::Vector3d place = objects::place(landmark.model);
  if (!in_range(landmark, (place - eye).norm(), config)) return false;
  return std::ranges::none_of(landmarks, [&](const Landmark& other) {
    const auto* cuboid = std::get_if<objects::Cuboid>(&other.model);
    return cuboid && &other != &landmark && believed(other, config) && crosses(*cuboid, eye, place);
  });
}

bool crosses(const objects::Cuboid& cuboid, const Eigen::Vector3d& from,
             const Eigen::Vector3d& to) {
  const SE3 T_cuboid_world = cuboid.pose.inverse();
  const Eigen::Vector3d start = T_cuboid_world * from;
  const Eigen::Vector3d way = T_cuboid_world * to - start;
  double enters = 0, leaves = 1;  // shares of the way
  for (int axis = 0; axis < 3; ++axis) {
    const double half = 0.5 * cuboid.size[axis];
    if (way[axis] == 0) {
      if (std::abs(start[axis]) > half) return false;
      continue;
    }
    double first = (-half - start[axis]) / way[axis];
    double last = (half - start[axis]) / way[axis];
    if (first > last) std::swap(first, last);
    enters = std::max(enters, first);
    leaves = std::min(leaves, last);
  }
  return enters < leaves;
}

}  // namespace saker::slam
