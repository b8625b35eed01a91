#include "saker/motion/free_space.h"

#include <algorithm>
#include <limits>

namespace saker::motion {
namespace {

using occupancy::Cell;
using occupancy::DistanceField;
using occupancy::OccupancyGrid;

constexpr double kFarthest_m = 2.5;     // more makes the field dearer and the steps hardly longer
constexpr double kFieldError_m = 0.05;  // the field reads too long by less

/// Only the cells of the box around the exempted places need a look.
void free_where_exempt(OccupancyGrid& grid, const Exemption& exemption,
                       const ClearanceConfig& config, const Eigen::Vector3d& low,
                       const Eigen::Vector3d& high) {
  if (!low.allFinite()) return;
  const Eigen::Vector3i first = grid.index_of(low).cwiseMax(0);
  const Eigen::Vector3i last = grid.index_of(high).cwiseMin(grid.size - Eigen::Vector3i::Ones());
  for (int z = first.z(); z <= last.z(); ++z)
    for (int y = first.y(); y <= last.y(); ++y)
      for (int x = first.x(); x <= last.x(); ++x) {
        Cell& cell = grid.cells[grid.offset({x, y, z})];
        if (cell == Cell::unknown && exemption.contains(grid.centre_of({x, y, z}), config))
          cell = Cell::free;
      }
}

OccupancyGrid with_exemption(OccupancyGrid grid, const Exemption& exemption,
                             const ClearanceConfig& config) {
  const double r = config.takeoff_radius_m;
  free_where_exempt(grid, exemption, config, exemption.takeoff - Eigen::Vector3d(r, r, 0),
                    exemption.takeoff + Eigen::Vector3d(r, r, config.takeoff_height_m));
  const Eigen::Vector3d ball = Eigen::Vector3d::Constant(config.vehicle_ball_m);
  free_where_exempt(grid, exemption, config, exemption.vehicle - ball, exemption.vehicle + ball);
  return grid;
}

}  // namespace

FreeSpace::FreeSpace(const OccupancyGrid& snapshot, const ClearanceConfig& config,
                     const Geofence& fence, const Exemption& exemption)
    : config_(config),
      fence_(fence),
      vehicle_(exemption.vehicle),
      grid_(with_exemption(snapshot, exemption, config)),
      vehicle_is_clear_(grid_.at(vehicle_) == Cell::free),
      inside_of_vehicle_m_(fence.inside_m(vehicle_)) {
  take_close_cells();
  field_ = DistanceField(grid_, kFarthest_m, occupancy::UnknownCells::occupied);
  field_of_vehicle_m_ = field_m(vehicle_);
  for (int y = 0; y < grid_.size.y(); ++y)
    for (int x = 0; x < grid_.size.x(); ++x)
      inside_polygon_m_.push_back(fence.inside_polygon_m(grid_.centre_of({x, y, 0}).head<2>()));
}

/// Takes them out of the grid, so that the field knows what else is there.
void FreeSpace::take_close_cells() {
  if (!vehicle_is_clear_) return;
  const double within_m = config_.robot_radius_m + kFieldError_m;
  const Eigen::Vector3d reach = Eigen::Vector3d::Constant(within_m);
  const Eigen::Vector3i first = grid_.index_of(vehicle_ - reach).cwiseMax(0);
  const Eigen::Vector3i last =
      grid_.index_of(vehicle_ + reach).cwiseMin(grid_.size - Eigen::Vector3i::Ones());
  for (int z = first.z(); z <= last.z(); ++z)
    for (int y = first.y(); y <= last.y(); ++y)
      for (int x = first.x(); x <= last.x(); ++x) {
        Cell& cell = grid_.cells[grid_.offset({x, y, z})];
        const double now_m = grid_.distance_m({x, y, z}, vehicle_);
        if (cell == Cell::free || now_m >= within_m) continue;
        close_.push_back({{x, y, z}, now_m});
        cell = Cell::free;
      }
}

double FreeSpace::clearance_m(const Eigen::Vector3d& p) const {
  double nearest_m = field_m(p);
  for (const CloseCell& cell : close_)
    nearest_m = std::min(nearest_m, grid_.distance_m(cell.index, p));
  return nearest_m;
}

double FreeSpace::close_slack_m(const Eigen::Vector3d& p) const {
  double slack_m = std::numeric_limits<double>::infinity();
  for (const CloseCell& cell : close_)
    slack_m = std::min(slack_m, grid_.distance_m(cell.index, p) - cell.now_m);
  return slack_m;
}

double FreeSpace::field_m(const Eigen::Vector3d& p) const {
  const Eigen::Vector3d from_centres =
      (p - grid_.origin) / grid_.resolution_m - Eigen::Vector3d::Constant(0.5);
  const Eigen::Vector3d floor = from_centres.array().floor();
  const bool inside =
      (floor.array() >= 0).all() && (floor.array() + 1 < grid_.size.cast<double>().array()).all();
  if (!inside) return 0;
  const Eigen::Vector3i c = floor.cast<int>();
  const Eigen::Vector3d u = from_centres - floor;
  const auto along_x = [&](int y, int z) {
    const double a = field_.of_cell({c.x(), c.y() + y, c.z() + z});
    const double b = field_.of_cell({c.x() + 1, c.y() + y, c.z() + z});
    return a + u.x() * (b - a);
  };
  const double low = along_x(0, 0) + u.y() * (along_x(1, 0) - along_x(0, 0));
  const double high = along_x(0, 1) + u.y() * (along_x(1, 1) - along_x(0, 1));
  return low + u.z() * (high - low);
}

bool FreeSpace::near_vehicle(const Eigen::Vector3d& p) const {
  return (p - vehicle_).squaredNorm() < config_.vehicle_ball_m * config_.vehicle_ball_m;
}

double FreeSpace::needed_clearance_m(bool near_vehicle) const {
  const double needed = config_.least_m() + config_.planning_slack_m;
  return near_vehicle ? std::min(needed, field_of_vehicle_m_) : needed;
}

double FreeSpace::needed_inside_m(bool near_vehicle) const {
  const double needed = config_.planning_slack_m;
  return near_vehicle ? std::min(needed, inside_of_vehicle_m_) : needed;
}

double FreeSpace::slack_m(const Eigen::Vector3d& p) const {
  const bool near = near_vehicle(p);
  return std::min({field_m(p) - needed_clearance_m(near),
                   fence_.inside_m(p) - needed_inside_m(near), close_slack_m(p)});
}

bool FreeSpace::free(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const {
  const double length = (b - a).norm();
  if (!std::isfinite(length)) return false;
  const Eigen::Vector3d direction = length > 0 ? Eigen::Vector3d((b - a) / length) : b - a;
  for (double s = 0; s < length;) {
    const double slack = slack_m(a + s * direction);
    if (slack < 0) return false;
    s += std::max(slack, 0.5 * grid_.resolution_m);
  }
  return free(b);
}

bool FreeSpace::safe(const Eigen::Vector3d& p) const {
  const bool near = near_vehicle(p);
  const double radius_m = config_.robot_radius_m;
  const double needed = std::max(near ? std::min(radius_m, field_of_vehicle_m_) : radius_m,
                                 needed_clearance_m(near) - config_.planning_slack_m);
  const bool leaves = std::ranges::all_of(close_, [&](const CloseCell& cell) {
    return grid_.distance_m(cell.index, p) >= config_.leaving_m(cell.now_m);
  });
  return leaves && field_m(p) >= needed &&
         fence_.inside_m(p) >= needed_inside_m(near) - config_.planning_slack_m;
}

bool FreeSpace::vehicle_is_clear() const { return vehicle_is_clear_; }

bool FreeSpace::cell_far_enough(const Eigen::Vector3i& cell, double distance_m) const {
  const double least_m = std::min(config_.robot_radius_m, field_of_vehicle_m_);
  if (distance_m < least_m) return false;  // most cells that are not free end here
  const Eigen::Vector3d p = grid_.centre_of(cell);
  const bool near = near_vehicle(p);
  const auto column = static_cast<std::size_t>(cell.y() * grid_.size.x() + cell.x());
  const double inside_m = std::min(fence_.inside_band_m(p.z()), inside_polygon_m_[column]);
  return distance_m >= needed_clearance_m(near) && inside_m >= needed_inside_m(near) &&
         close_slack_m(p) >= 0;
}

bool FreeSpace::cell_free(const Eigen::Vector3i& cell) const {
  return cell_far_enough(cell, field_.of_cell(cell));
}

bool FreeSpace::cell_may_be_free(const Eigen::Vector3i& cell, const DistanceField& occupied) const {
  return cell_far_enough(cell, occupied.of_cell(cell));
}

DistanceField FreeSpace::occupied_field() const {
  const double enough_m = config_.least_m() + config_.planning_slack_m + grid_.resolution_m;
  return DistanceField(grid_, enough_m, occupancy::UnknownCells::free);
}

}  // namespace saker::motion
