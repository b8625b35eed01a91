#include "saker/active/reachability.h"

#include <algorithm>
#include <cmath>

namespace saker::active {

using Eigen::Vector3d;
using Eigen::Vector3i;

Reachability::Reachability(const Surroundings& surroundings, const Vector3d& vehicle,
                           double clearance_m, const InGeofence& in_geofence)
    : surroundings_(surroundings) {
  if (!surroundings.grid) return;
  const occupancy::OccupancyGrid& grid = *surroundings.grid;
  fine_ = std::max(static_cast<int>(std::lround(0.5 * clearance_m / grid.resolution_m)), 1);
  size_ = ((grid.size.array() + fine_ - 1) / fine_).matrix();
  const Vector3i start = cell_of(vehicle);
  if (inside(start)) flood(start, in_geofence);
}

Vector3i Reachability::cell_of(const Vector3d& p_world) const {
  const Vector3i fine = surroundings_.grid->index_of(surroundings_.T_odom_world * p_world);
  return fine.unaryExpr([&](int i) { return i < 0 ? -1 : i / fine_; });
}

bool Reachability::inside(const Vector3i& cell) const {
  return (cell.array() >= 0).all() && (cell.array() < size_.array()).all();
}

/// Neither the cell nor one of its eight neighbours in x-y holds anything occupied.
std::vector<bool> Reachability::passable() const {
  const occupancy::OccupancyGrid& grid = *surroundings_.grid;
  std::vector<bool> free(static_cast<std::size_t>(size_.prod()), true);
  for (int z = 0; z < grid.size.z(); ++z) {
    for (int y = 0; y < grid.size.y(); ++y) {
      for (int x = 0; x < grid.size.x(); ++x) {
        if (grid.cells[grid.offset({x, y, z})] != occupancy::Cell::occupied) continue;
        const Vector3i cell = Vector3i(x, y, z) / fine_;
        for (int dy = -1; dy <= 1; ++dy) {
          for (int dx = -1; dx <= 1; ++dx) {
            const Vector3i near = cell + Vector3i(dx, dy, 0);
            if (inside(near)) free[offset(near)] = false;
          }
        }
      }
    }
  }
  return free;
}

void Reachability::flood(const Vector3i& start, const InGeofence& in_geofence) {
  const std::vector<bool> free = passable();
  const SE3 T_world_odom = surroundings_.T_odom_world.inverse();
  const occupancy::OccupancyGrid& grid = *surroundings_.grid;
  reached_.assign(free.size(), false);
  reached_[offset(start)] = true;
  reaches_edge_ = false;
  std::vector<Vector3i> open = {start};
  while (!open.empty()) {
    const Vector3i cell = open.back();
    open.pop_back();
    for (int side = 0; side < 6; ++side) {
      Vector3i next = cell;
      next[side / 2] += side % 2 ? 1 : -1;
      if (!inside(next)) {
        reaches_edge_ = reaches_edge_ || side < 4;
        continue;
      }
      if (reached_[offset(next)] || !free[offset(next)]) continue;
      const Vector3d centre =
          grid.origin + (next.cast<double>().array() + 0.5).matrix() * (fine_ * grid.resolution_m);
      if (!in_geofence(T_world_odom * centre)) continue;
      reached_[offset(next)] = true;
      open.push_back(next);
    }
  }
}

bool Reachability::reaches(const Vector3d& p) const {
  if (reached_.empty()) return true;
  const Vector3i cell = cell_of(p);
  return inside(cell) ? reached_[offset(cell)] : reaches_edge_;
}

}  // namespace saker::active
