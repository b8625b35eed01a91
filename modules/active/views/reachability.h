#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "saker/active/views/viewpoint.h"

namespace saker::active {

/// What of an occupancy block may be reached from where the vehicle is: through all that is not
/// known to be occupied, with a vehicle's width of room, inside the geofence.
///
/// Reads the block (`odom`), answers for places in `world`. Method: a flood from face to face over
/// cells of half the clearance, each passable when neither it nor a neighbour in x-y holds anything
/// occupied. It errs on the side of "reachable" in the unknown, and of "not" in gaps of less than
/// four cells; motion planning has the last word. Cost: the first question floods, a few
/// milliseconds for a block of 40 m; the others look up.
class Reachability {
 public:
  /// Everything may be reached.
  Reachability() = default;

  /// Without a block everything may be reached.
  Reachability(const OccupancyView& block, const Eigen::Vector3d& vehicle, double clearance_m,
               InGeofence in_geofence);

  /// `p` in world. Outside of the block: whether the flood reached its edge.
  [[nodiscard]] bool reaches(const Eigen::Vector3d& p) const;

 private:
  struct Flood {
    std::vector<bool> reached;  ///< cells; empty: all
    bool reaches_edge = true;
  };

  [[nodiscard]] Eigen::Vector3i cell_of(const Eigen::Vector3d& p_world) const;
  [[nodiscard]] bool inside(const Eigen::Vector3i& cell) const;
  [[nodiscard]] int offset(const Eigen::Vector3i& cell) const {
    return (cell.z() * size_.y() + cell.y()) * size_.x() + cell.x();
  }
  [[nodiscard]] std::vector<bool> passable() const;
  [[nodiscard]] Flood flood_from(const Eigen::Vector3i& start) const;

  OccupancyView block_;
  Eigen::Vector3d vehicle_ = Eigen::Vector3d::Zero();
  InGeofence in_geofence_;
  int fine_ = 1;  ///< of the block's cells along an edge of ours
  Eigen::Vector3i size_ = Eigen::Vector3i::Zero();
  mutable std::optional<Flood> flood_;  ///< none before the first question
};

}  // namespace saker::active
