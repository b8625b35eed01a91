#pragma once

#include <Eigen/Core>

#include "saker/core/se3.h"
#include "saker/objects/models.h"
#include "saker/occupancy/grid.h"

/// What occupied cells of the block hide, and what they block.
///
/// Reads the occupancy block (`odom`), makes answers about places in `world`. Method: rays through
/// the block from the eye to the target, in steps of half a cell. Cost: five rays a view.
namespace saker::active {

/// An occupancy block seen from `world`. Without a block everything is unknown.
struct OccupancyView {
  const occupancy::OccupancyGrid* grid = nullptr;
  SE3 T_odom_world = SE3::Identity();

  [[nodiscard]] occupancy::Cell at(const Eigen::Vector3d& p_world) const {
    return grid ? grid->at(T_odom_world * p_world) : occupancy::Cell::unknown;
  }
  /// Whether a cell's centre within `radius` is occupied.
  [[nodiscard]] bool blocked(const Eigen::Vector3d& p_world, double radius) const;
};

/// Share of the target that no occupied cell hides, by rays to its vertical edges and its middle.
/// Cells of the target itself (within `own_margin_m`) and unknown ones hide nothing.
[[nodiscard]] double visible_share(const Eigen::Vector3d& eye, const objects::Cuboid& target,
                                   const OccupancyView& block, double own_margin_m);

}  // namespace saker::active
