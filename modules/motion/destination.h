#pragma once

#include <Eigen/Core>
#include <vector>

#include "saker/core/budget.h"
#include "saker/motion/free_space.h"

namespace saker::motion {

/// Offsets of the free cells that can be reached from `start` from face to face, `start`'s
/// neighbours first. Empty: nothing next to it is free. A gap less than a cell wider than the
/// vehicle with its margins may be missed. At the deadline it returns those found so far.
[[nodiscard]] std::vector<int> reachable_cells(const FreeSpace& space, const Eigen::Vector3d& start,
                                               const core::Budget& budget);

enum class DestinationKind {
  goal,         ///< the goal itself, or as near to it as the tolerance allows
  on_the_way,   ///< the end of what is known to be free
  blocked,      ///< no cell near the goal may be free
  enclosed,     ///< what is known to be occupied cuts it off
  out_of_time,  ///< the deadline came first
};

struct Destination {
  DestinationKind kind = DestinationKind::out_of_time;
  Eigen::Vector3d point = Eigen::Vector3d::Constant(NAN);
};

/// Where to fly for a goal: of the cells that can be reached, the one from which the way on to the
/// goal, through all that may be free, is shortest. So the vehicle goes round what it sees, and
/// does not wait behind a wall for being near.
///
/// Dijkstra's wave from the goal (from the faces of the block when the goal lies outside of it)
/// through cells that are not known to be blocked; the first reached cell that it meets wins.
[[nodiscard]] Destination find_destination(const FreeSpace& space, const std::vector<int>& reached,
                                           const Eigen::Vector3d& goal, double tolerance_m,
                                           const core::Budget& budget);

}  // namespace saker::motion
