#include "saker/autonomy/takeoff_column.h"

#include <algorithm>

namespace saker::autonomy {
namespace {

using occupancy::Cell;
using State = TakeoffColumn::State;

/// Of a layer of the column.
State layer(const occupancy::OccupancyGrid& grid, const Eigen::Vector3d& centre, double radius_m,
            const motion::ClearanceConfig& clearance, const motion::Exemption& exemption) {
  const double cell = grid.resolution_m;
  const int reach = static_cast<int>(std::ceil(radius_m / cell));
  State worst = State::free;
  for (int y = -reach; y <= reach; ++y) {
    for (int x = -reach; x <= reach; ++x) {
      const Eigen::Vector3d p = centre + cell * Eigen::Vector3d(x, y, 0);
      if ((p - centre).norm() > radius_m) continue;
      const Cell seen = grid.at(p);
      if (seen == Cell::occupied) return State::occupied;
      if (seen == Cell::unknown && !exemption.contains(p, clearance)) worst = State::unknown;
    }
  }
  return worst;
}

}  // namespace

core::Text TakeoffColumn::text() const {
  if (state == State::occupied) return core::text("something is {:.1f} m above it", above_m);
  return core::text(
      "from {:.1f} m above it on nothing was seen, nor is it stated free "
      "(motion.clearance.takeoff_height_m, takeoff_radius_m)",
      above_m);
}

TakeoffColumn look_up(const occupancy::OccupancyGrid& grid, const Eigen::Vector3d& body,
                      double height_m, const motion::ClearanceConfig& clearance,
                      const motion::Exemption& exemption) {
  TakeoffColumn column;
  if (!body.allFinite() || !(grid.resolution_m > 0)) return column;
  column.state = State::free;
  const double radius_m = clearance.robot_radius_m + grid.resolution_m;
  const double top = height_m + clearance.robot_radius_m;
  for (double above = clearance.robot_radius_m; above <= top; above += grid.resolution_m) {
    const State found =
        layer(grid, body + above * Eigen::Vector3d::UnitZ(), radius_m, clearance, exemption);
    if (found <= column.state) continue;
    column = {found, above};
    if (found == State::occupied) break;
  }
  return column;
}

}  // namespace saker::autonomy
