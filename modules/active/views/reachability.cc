#include "saker/active/views/reachability.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace saker::active {

using Eigen::Vector3d;
using Eigen::Vector3i;

Reachability::Reachability(const OccupancyView& block, const Vector3d& vehicle, double clearance_m,
                           InGeofence in_geofence)
    : block_(block), vehicle_(vehicle), in_geofence_(std::move(in_geofence)) {
  if (!block.grid) return;
  const occupancy::OccupancyGrid& grid = *block.grid;
  fine_ = std::max(static_cast<int>(std::lround(0.5 * clearance_m / grid.resolution_m)), 1);
  size_ = ((grid.size.array() + fine_ - 1) / fine_).matrix();
}

Vector3i Reachability::cell_of(const Vector3d& p_world) const {
  const Vector3i fine = block_.grid->index_of(block_.T_odom_world * p_world);
  return fine.unaryExpr([&](int i) { return i < 0 ? -1 : i / fine_; });
}

bool Reachability::inside(const Vector3i& cell) const {
  return (cell.array() >= 0).all() && (cell.array() < size_.array()).all();
}

/// Neither the cell nor one of its eight neighbours in x-y holds anything occupied.
std::vector<bool> Reachability::passable() const {
  const occupancy::OccupancyGrid& grid = *block_.grid;
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

Reachability::Flood Reachability::flood_from(const Vector3i& start) const {
  Flood flood;
  if (!inside(start)) return flood;
  const std::vector<bool> free = passable();
  const SE3 T_world_odom = block_.T_odom_world.inverse();
  const occupancy::OccupancyGrid& grid = *block_.grid;
  flood.reached.assign(free.size(), false);
  flood.reached[offset(start)] = true;
  flood.reaches_edge = false;
  std::vector<Vector3i> open = {start};
  while (!open.empty()) {
    const Vector3i cell = open.back();
    open.pop_back();
    for (int side = 0; side < 6; ++side) {
      Vector3i next = cell;
      next[side / 2] += side % 2 ? 1 : -1;
      if (!inside(next)) {
        flood.reaches_edge = flood.reaches_edge || side < 4;
        continue;
      }
      if (flood.reached[offset(next)] || !free[offset(next)]) continue;
      const Vector3d centre =
          grid.origin + (next.cast<double>().array() + 0.5).matrix() * (fine_ * grid.resolution_m);
      if (!in_geofence_(T_world_odom * centre)) continue;
      flood.reached[offset(next)] = true;
      open.push_back(next);
    }
  }
  return flood;
}

bool Reachability::reaches(const Vector3d& p) const {
  if (!block_.grid) return true;
  if (!flood_) flood_ = flood_from(cell_of(vehicle_));
  if (flood_->reached.empty()) return true;
  const Vector3i cell = cell_of(p);
  return inside(cell) ? flood_->reached[offset(cell)] : flood_->reaches_edge;
}

}  // namespace saker::active
