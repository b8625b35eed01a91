#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <vector>

#include "saker/objects/object_map.h"
#include "saker/occupancy/grid.h"

/// A made street for tests: cars as boxes, walls, and the occupancy block around them.
namespace saker::active::made {

constexpr objects::ClassId kVehicle = 1;
constexpr objects::ClassId kTrunk = 2;

inline objects::Cuboid car(double x, double y, double yaw = 0) {
  objects::Cuboid cuboid;
  cuboid.size = {4.4, 1.8, 1.5};
  cuboid.pose = Eigen::Translation3d(x, y, 0.75) * Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ());
  return cuboid;
}

inline objects::MapObject vehicle(int id, const objects::Cuboid& cuboid) {
  objects::MapObject object;
  object.id = id;
  object.class_id = kVehicle;
  object.model = cuboid;
  return object;
}

inline objects::ObjectMap map_of(const std::vector<objects::Cuboid>& cars) {
  objects::ObjectMap map;
  for (const objects::Cuboid& cuboid : cars) {
    map.objects.push_back(vehicle(static_cast<int>(map.objects.size()), cuboid));
  }
  return map;
}

/// All free: x and y from −reach to reach, z from −1 to 7 m.
inline occupancy::OccupancyGrid free_grid(double reach = 30, double resolution = 0.5) {
  occupancy::OccupancyGrid grid;
  grid.resolution_m = resolution;
  grid.origin = {-reach, -reach, -1};
  grid.size = (Eigen::Vector3d(2 * reach, 2 * reach, 8) / resolution).cast<int>();
  grid.cells.assign(static_cast<std::size_t>(grid.size.prod()), occupancy::Cell::free);
  return grid;
}

/// Fills the cells with their centres in the upright box.
inline void fill(occupancy::OccupancyGrid& grid, const Eigen::Vector3d& low,
                 const Eigen::Vector3d& high, occupancy::Cell value = occupancy::Cell::occupied) {
  const Eigen::Vector3i from = grid.index_of(low).cwiseMax(0);
  const Eigen::Vector3i to = grid.index_of(high).cwiseMin(grid.size - Eigen::Vector3i::Ones());
  const Eigen::AlignedBox3d box(low, high);
  for (int z = from.z(); z <= to.z(); ++z) {
    for (int y = from.y(); y <= to.y(); ++y) {
      for (int x = from.x(); x <= to.x(); ++x) {
        if (box.contains(grid.centre_of({x, y, z}))) grid.cells[grid.offset({x, y, z})] = value;
      }
    }
  }
}

inline std::shared_ptr<const occupancy::OccupancyGrid> shared(occupancy::OccupancyGrid grid) {
  return std::make_shared<const occupancy::OccupancyGrid>(std::move(grid));
}

/// Known all over, with the cars in it, which are not turned.
inline std::shared_ptr<const occupancy::OccupancyGrid> block_of(
    const std::vector<objects::Cuboid>& cars) {
  occupancy::OccupancyGrid grid = free_grid(60);
  for (const objects::Cuboid& it : cars) {
    const Eigen::Vector3d half = 0.5 * it.size, place = it.pose.translation();
    fill(grid, place - half, place + half);
  }
  return shared(std::move(grid));
}

}  // namespace saker::active::made
