#include "saker/slam/sight.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <variant>

namespace saker::slam {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Eigen::Vector3d middle(const Model& model) {
  const auto* cylinder = std::get_if<objects::Cylinder>(&model);
  return cylinder ? Eigen::Vector3d(cylinder->root + 0.5 * cylinder->height * cylinder->axis)
                  : objects::place(model);
}

bool in_range(const Landmark& landmark, double distance, const LandmarkConfig& config) {
  return distance <= landmark.farthest &&
         distance >= std::min(landmark.nearest, config.surely_seen_m);
}

}  // namespace

std::vector<objects::Cuboid> believed_cuboids(std::span<const Landmark> landmarks,
                                              const LandmarkConfig& config) {
  std::vector<objects::Cuboid> all;
  for (const Landmark& landmark : landmarks) {
    const auto* cuboid = std::get_if<objects::Cuboid>(&landmark.model);
    if (cuboid && believed(landmark, config)) all.push_back(*cuboid);
  }
  return all;
}

bool in_view(const Landmark& landmark, const Eigen::Vector3d& eye,
             std::span<const objects::Cuboid> cuboids, const LandmarkConfig& config) {
  if (!in_range(landmark, (objects::place(landmark.model) - eye).norm(), config)) return false;
  return std::ranges::none_of(cuboids, [&](const objects::Cuboid& cuboid) {
    return between(cuboid, eye, middle(landmark.model));
  });
}

bool between(const objects::Cuboid& cuboid, const Eigen::Vector3d& from,
             const Eigen::Vector3d& to) {
  const SE3 T_cuboid_world = cuboid.pose.inverse();
  const Eigen::Vector3d start = T_cuboid_world * from;
  const Eigen::Vector3d way = T_cuboid_world * to - start;
  double enters = -kInfinity, leaves = kInfinity;  // shares of the way
  for (int axis = 0; axis < 3; ++axis) {
    double first = (-0.5 * cuboid.size[axis] - start[axis]) / way[axis];
    double last = (0.5 * cuboid.size[axis] - start[axis]) / way[axis];
    if (first > last) std::swap(first, last);
    enters = std::max(enters, first);
    leaves = std::min(leaves, last);
  }
  return 0 < enters && enters < leaves && leaves < 1;
}

}  // namespace saker::slam
