#include "saker/active/discovery/column.h"

#include <algorithm>
#include <limits>
#include <variant>

namespace saker::active {
namespace {

constexpr double kHeights[] = {0.5, 0.9, 1.3};  // m: clear of the ground's cells, in any vehicle
constexpr double kMargin = 0.5;                 // m around a mapped object: its error and a cell

bool within(const Eigen::Vector2d& place, const objects::Model& model) {
  if (const auto* cylinder = std::get_if<objects::Cylinder>(&model)) {
    return (place - cylinder->root.head<2>()).norm() <= cylinder->radius + kMargin;
  }
  const auto& cuboid = std::get<objects::Cuboid>(model);
  const Eigen::Vector3d p(place.x(), place.y(), cuboid.pose.translation().z());
  const Eigen::Vector3d in_cuboid = cuboid.pose.inverse() * p;
  const Eigen::Array2d half = 0.5 * cuboid.size.head<2>();
  return (in_cuboid.head<2>().array().abs() <= half + kMargin).all();
}

}  // namespace

double ground_height(const objects::ObjectMap* map, const Eigen::Vector2d& place) {
  double height = 0, nearest = std::numeric_limits<double>::infinity();
  if (!map) return height;
  for (const objects::GroundPlane& plane : map->ground) {
    const double distance = (plane.point.head<2>() - place).squaredNorm();
    if (!(distance < nearest)) continue;
    nearest = distance;
    height = plane.point.z();
  }
  return height;
}

Standing standing_at(const Eigen::Vector2d& place, const OccupancyView& block,
                     const objects::ObjectMap* map) {
  if (map && std::ranges::any_of(map->objects, [&](const objects::MapObject& object) {
        return within(place, object.model);
      })) {
    return Standing::mapped;
  }
  const double ground = ground_height(map, place);
  bool known = true;
  for (const double height : kHeights) {
    switch (block.at({place.x(), place.y(), ground + height})) {
      case occupancy::Cell::occupied:
        return Standing::something;
      case occupancy::Cell::unknown:
        known = false;
        break;
      case occupancy::Cell::free:
        break;
    }
  }
  return known ? Standing::nothing : Standing::unknown;
}

}  // namespace saker::active
