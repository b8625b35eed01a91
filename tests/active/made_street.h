#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <vector>

#include "objects/object_map.h"
#include "occupancy/grid.h"

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
  const Eigen::AlignedBox3d box(low, high);
  for (int z = 0; z < grid.size.z(); ++z) {
    for (int y = 0; y < grid.size.y(); ++y) {
      for (int x = 0; x < grid.size.x(); ++x) {
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
    const Eigen::Vector3d half(2.2, 0.9, 0.8), place = it.pose.translation();
    const Eigen::Vector3i low = grid.index_of(place - half), high = grid.index_of(place + half);
    for (int z = low.z(); z <= high.z(); ++z) {
      for (int y = low.y(); y <= high.y(); ++y) {
        for (int x = low.x(); x <= high.x(); ++x) {
          grid.cells[grid.offset({x, y, z})] = occupancy::Cell::occupied;
        }
      }
    }
  }
  return shared(std::move(grid));
}

}  // namespace saker::active::made
