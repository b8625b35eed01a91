#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

/// Lines of a sweep over an area: back and forth, like an ox that ploughs (boustrophedon).
///
/// Reads the corners of a polygon, makes lines and stops on them; all in one frame, x-y. Cost: once
/// a mission.
namespace saker::active {

struct SweepLine {
  Eigen::Vector2d from, to;  ///< m
};

/// Parallel lines over a polygon, at most `spacing_m` apart and half of that from its outermost
/// corners, cut where they leave it, in the order and the directions in which they are flown.
///
/// They run along that edge across which the polygon is narrowest: the fewest lines and turns for a
/// convex one (Huang, "Optimal line-sweep-based decompositions", ICRA 2001). A spike between two
/// lines, and what a slanting edge cuts off, may be farther from them: see Coverage.
/// \param corners at least three, in their order around the polygon, which may be concave.
[[nodiscard]] std::vector<SweepLine> sweep_lines(std::span<const Eigen::Vector2d> corners,
                                                 double spacing_m);

/// Places on the lines, at most `step_m` apart, and `inset_m` from where a line ends. A line that
/// is too short for that has its middle.
[[nodiscard]] std::vector<Eigen::Vector2d> stops_on(std::span<const SweepLine> lines, double step_m,
                                                    double inset_m);

}  // namespace saker::active
