#pragma once

#include <vector>

#include "saker/occupancy/grid.h"

namespace saker::occupancy {

/// What a cell that was never seen counts as.
enum class UnknownCells { free, occupied };

/// How far every cell of a grid is from the surface of the nearest occupied cell.
///
/// Exact up to `max_distance_m`: the squared distance from a cell's centre to a cube is a sum over
/// the axes, so three passes of a windowed minimum give it (Felzenszwalb and Huttenlocher,
/// "Distance Transforms of Sampled Functions", 2012, with a window in place of their envelope).
/// Cost: 160 × 160 × 48 cells to 5 m: README.md.
class DistanceField {
 public:
  DistanceField() = default;  ///< of no grid: everything is outside

  /// \param max_distance_m greater distances read as it; at most 90 cells
  /// \param unknown `occupied` holds for what lies outside of the grid too
  DistanceField(const OccupancyGrid& grid, double max_distance_m, UnknownCells unknown);

  /// m, from the centre of a cell of the grid; 0 in an occupied one.
  [[nodiscard]] double of_cell(const Eigen::Vector3i& cell) const {
    return distance_m_[geometry_.offset(cell)];
  }

  /// m, never more than the true distance from `p`, and less by a cell's diagonal at most. Outside
  /// of the grid: 0 where the unknown is occupied, else `max_distance_m`.
  [[nodiscard]] double at(const Eigen::Vector3d& p) const;

  [[nodiscard]] double max_distance_m() const { return max_distance_m_; }
  [[nodiscard]] const Eigen::Vector3i& size() const { return geometry_.size; }

 private:
  OccupancyGrid geometry_;  // without its cells
  std::vector<float> distance_m_;
  double max_distance_m_ = 0;
  double outside_m_ = 0;
};

}  // namespace saker::occupancy
