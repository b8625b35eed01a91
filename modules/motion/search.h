#pragma once

#include <cstdint>
#include <span>

#include "saker/core/budget.h"
#include "saker/core/config.h"
#include "saker/motion/path.h"

namespace saker::motion {

class FreeSpace;

/// How paths are looked for.
struct SearchConfig {
  int attempts = 8;
  double range_m = 5;
  int shortcuts = 160;
  double widest_corner_m = 3;
  double goal_tolerance_m = 1.0;
  double least_progress_m = 1.0;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field(
        "attempts", attempts, {1, 20}, "",
        "searches of which the shortest path wins: one alone is 8 % longer than the best of sixty, "
        "eight are 1 %");
    v.field("range_m", range_m, {0.5, 50}, "m",
            "longest branch of RRT-Connect: about the distance between obstacles");
    v.field("shortcuts", shortcuts, {0, 10000}, "",
            "random cuts tried on each path: twice as many gain less than 1 %");
    v.field("widest_corner_m", widest_corner_m, {0.1, 20}, "m",
            "a corner is rounded from at most this far: more gains no time at the highest speed");
    v.field("goal_tolerance_m", goal_tolerance_m, {0.01, 10}, "m",
            "a goal too near to an obstacle is moved by at most this");
    v.field("least_progress_m", least_progress_m, {0.1, 20}, "m",
            "an end on the way that is no farther than this from the start is no progress");
  }
};

struct SearchResult {
  Waypoints path;  ///< from start to goal, both included; empty: none was found
  int iterations = 0;
};

/// The shortest of several paths found by RRT-Connect (Kuffner & LaValle, ICRA 2000; OMPL's), each
/// shortened by cuts. Samples come from the cells that are known to be reached, spread evenly
/// within each, by a generator of our own: the same seed gives the same bytes, whatever else the
/// process plans. RRT-Connect and not an optimising planner, because it finds its path in
/// milliseconds and cuts shorten it to within a few percent of the best (README.md).
/// \param reached  offsets of the cells of the space's block that samples are drawn from, not empty
[[nodiscard]] SearchResult search_path(const FreeSpace& space, std::span<const int> reached,
                                       const Eigen::Vector3d& start, const Eigen::Vector3d& goal,
                                       const SearchConfig& config, std::uint64_t seed,
                                       const core::Budget& budget);

}  // namespace saker::motion
