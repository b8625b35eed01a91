#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "saker/motion/clearance.h"
#include "saker/motion/geofence.h"
#include "saker/occupancy/distance_field.h"
#include "saker/occupancy/grid.h"

namespace saker::motion {

/// Where the body's centre may be: far enough from what is occupied or unknown in one snapshot, and
/// inside the geofence.
///
/// Distances are those of the field at the eight cells around, interpolated, which is too long by
/// at most 3 cm at 0.25 m cells: less than the planning slack. Where the vehicle already is nearer
/// to something, it may stay as near in its ball, so that it can leave. Cells nearer than its
/// radius are left out of the field and measured exactly, each by itself: it comes nearer to none
/// of them.
class FreeSpace {
 public:
  FreeSpace(const occupancy::OccupancyGrid& snapshot, const ClearanceConfig& config,
            const Geofence& fence, const Exemption& exemption);

  [[nodiscard]] const occupancy::OccupancyGrid& grid() const { return grid_; }

  /// m, to what is occupied or unknown, read up to 2.5 m.
  [[nodiscard]] double clearance_m(const Eigen::Vector3d& p) const;

  /// m, how much farther from everything than a plan must keep; negative: it may not be there.
  [[nodiscard]] double slack_m(const Eigen::Vector3d& p) const;
  [[nodiscard]] bool free(const Eigen::Vector3d& p) const { return slack_m(p) >= 0; }
  /// The whole leg, by sphere tracing in steps of at least half a cell.
  [[nodiscard]] bool free(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const;
  /// What a finished trajectory must keep: the same without the planning slack; the radius, or what
  /// there is of it where the vehicle is.
  [[nodiscard]] bool safe(const Eigen::Vector3d& p) const;
  /// Whether the vehicle's centre is in a cell that is free.
  [[nodiscard]] bool vehicle_is_clear() const;

  /// `free` at the centre of a cell.
  [[nodiscard]] bool cell_free(const Eigen::Vector3i& cell) const;
  /// The same if all that is unknown were free.
  [[nodiscard]] bool cell_may_be_free(const Eigen::Vector3i& cell,
                                      const occupancy::DistanceField& occupied) const;
  /// To what is occupied alone: for `cell_may_be_free`. Cost: a field.
  [[nodiscard]] occupancy::DistanceField occupied_field() const;

 private:
  /// Not free, and about as near to the vehicle as its radius.
  struct CloseCell {
    Eigen::Vector3i index;
    double now_m;  // from its surface to the vehicle
  };

  void take_close_cells();
  [[nodiscard]] double field_m(const Eigen::Vector3d& p) const;
  [[nodiscard]] double close_slack_m(const Eigen::Vector3d& p) const;
  [[nodiscard]] bool near_vehicle(const Eigen::Vector3d& p) const;
  [[nodiscard]] double needed_clearance_m(bool near_vehicle) const;
  [[nodiscard]] double needed_inside_m(bool near_vehicle) const;
  [[nodiscard]] bool cell_far_enough(const Eigen::Vector3i& cell, double distance_m) const;

  ClearanceConfig config_;
  const Geofence& fence_;
  Eigen::Vector3d vehicle_;
  occupancy::OccupancyGrid grid_;  // with the exempted unknown and the close cells free
  std::vector<CloseCell> close_;
  bool vehicle_is_clear_ = false;
  occupancy::DistanceField field_;
  std::vector<double> inside_polygon_m_;  // of the geofence, a column of cells; x runs fastest
  double field_of_vehicle_m_ = NAN;
  double inside_of_vehicle_m_ = NAN;
};

}  // namespace saker::motion
