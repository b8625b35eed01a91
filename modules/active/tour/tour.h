#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "saker/core/budget.h"
#include "saker/core/config.h"

/// The order of the tour: a travelling salesman's path from where the vehicle is, through all
/// stops, to a given end or to none.
///
/// Reads costs between places, makes their order; no frame. Cost: 0.9 s for 1,002 stops.
/// Method: exact by dynamic programming (Held and Karp, J. SIAM 10, 1962) for a few stops. Beyond:
/// nearest neighbour, then 2-opt (Croes 1958) and Or-opt (Or 1976) with neighbour lists and
/// don't-look bits (Bentley, ORSA J. Computing 4, 1992), then iterated local search with double
/// bridges (Martin, Otto and Felten 1991) of neighbouring segments. Costs are symmetric between
/// stops, in any unit; here metres. The same input, seed and number of kicks give the same tour.
namespace saker::active {

struct TourConfig {
  int exact_up_to = 12;
  int neighbours = 10;
  int kicks_per_stop = 60;
  int segment = 50;
  int seed = 1;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("exact_up_to", exact_up_to, {0, 15}, "",
            "stops up to which the tour is the shortest there is: 2^n n² steps");
    v.field("neighbours", neighbours, {4, 30}, "", "nearest stops that a stop may be joined to");
    v.field("kicks_per_stop", kicks_per_stop, {0, 10000}, "",
            "perturbations a stop, when the budget lasts");
    v.field("segment", segment, {2, 1000}, "",
            "stops in the longest segment that a perturbation moves: short ones are mended fast");
    v.field("seed", seed, {0, 1e9}, "", "of the perturbations");
  }
};

/// Finite costs; `between` is symmetric.
struct TourProblem {
  Eigen::MatrixXd between;     ///< n×n
  Eigen::VectorXd from_start;  ///< n
  Eigen::VectorXd to_end;      ///< n; zeros where the tour may end at any stop
};

/// Straight distances, m. Without `end` the tour may end at any stop.
[[nodiscard]] TourProblem straight_lines(std::span<const Eigen::Vector3d> stops,
                                         const Eigen::Vector3d& start,
                                         const std::optional<Eigen::Vector3d>& end);

struct Tour {
  std::vector<int> order;  ///< each stop once
  double length = 0;       ///< from the start to the end
  bool exact = false;      ///< no shorter one exists
  int kicks = 0;           ///< perturbations tried
};

[[nodiscard]] double length_of(const TourProblem& problem, std::span<const int> order);

/// \param budget its iterations are perturbations; the local search before them always ends.
[[nodiscard]] Tour solve_tour(const TourProblem& problem, const TourConfig& config,
                              const core::Budget& budget);

}  // namespace saker::active
