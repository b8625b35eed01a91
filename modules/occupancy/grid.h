#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <vector>

#include "saker/core/time.h"

namespace saker::occupancy {

enum class Cell : std::uint8_t { unknown = 0, free = 1, occupied = 2 };

/// A dense block of the occupancy map around the vehicle, in `odom`: what the planner plans in and
/// what travels as `_OCCUPANCY`. Cell (0, 0, 0) has its lower corner at `origin`; x runs fastest.
struct OccupancyGrid {
  Time stamp = 0;
  double resolution_m = NAN;
  Eigen::Vector3d origin = Eigen::Vector3d::Constant(NAN);  ///< m, on the lattice of the map
  Eigen::Vector3i size = Eigen::Vector3i::Zero();           ///< cells
  std::vector<Cell> cells;

  [[nodiscard]] Eigen::Vector3i index_of(const Eigen::Vector3d& p) const {
    return ((p - origin) / resolution_m).array().floor().cast<int>();
  }
  [[nodiscard]] bool contains(const Eigen::Vector3i& i) const {
    return (i.array() >= 0).all() && (i.array() < size.array()).all();
  }
  [[nodiscard]] std::size_t offset(const Eigen::Vector3i& i) const {
    return (static_cast<std::size_t>(i.z()) * size.y() + i.y()) * size.x() + i.x();
  }
  [[nodiscard]] Eigen::Vector3d centre_of(const Eigen::Vector3i& i) const {
    return origin + resolution_m * (i.cast<double>().array() + 0.5).matrix();
  }
  /// m, from `p` to the surface of a cell, of one outside of the block too; 0 inside.
  [[nodiscard]] double distance_m(const Eigen::Vector3i& i, const Eigen::Vector3d& p) const {
    const Eigen::Array3d beyond = (centre_of(i) - p).cwiseAbs().array() - resolution_m / 2;
    return beyond.max(0).matrix().norm();
  }
  /// What was never seen is not free: outside the block everything is unknown.
  [[nodiscard]] Cell at(const Eigen::Vector3d& p) const {
    if (!p.allFinite()) return Cell::unknown;
    const Eigen::Vector3i i = index_of(p);
    return contains(i) ? cells[offset(i)] : Cell::unknown;
  }
};

}  // namespace saker::occupancy
