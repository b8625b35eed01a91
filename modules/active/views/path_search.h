#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "saker/active/belief/belief.h"

/// Which viewpoints to fly to, and in which order.
///
/// Reads beliefs, what each viewpoint measures and the times between them, makes the path that is
/// worth most. Frames: none, all are lengths and times. Cost: 13 ms for all 24,360 paths through 3
/// of 30 viewpoints and one object.
/// Method: paper, "Uncertainty minimization": all P(a, T) = a! / (a − T)! ordered paths through T
/// of the a samples; the one that takes most off the entropy is flown. That gain does not depend on
/// the order: ties are broken by flight time. Beyond the paper: several objects at once, the price
/// of a second of flight, and the drift of the pose on the way (then the order does count).
namespace saker::active {

/// What a viewpoint measures of one object.
struct CellMeasurement {
  int object = -1;  ///< index into PathProblem::objects
  int cell = -1;    ///< of the uncertainty model: counts once an object
  Measured measured;
};

struct PathProblem {
  std::vector<Belief> objects;
  std::vector<double> drifted_m;                    ///< flown since each object was first seen
  std::vector<std::vector<CellMeasurement>> stops;  ///< of cells that were not seen yet
  Eigen::VectorXd to_m, to_s;                       ///< from the vehicle to each stop
  Eigen::VectorXd on_s;                             ///< from each stop to the next target
  Eigen::MatrixXd between_m, between_s;
  double direct_s = 0;     ///< from the vehicle to the next target
  double dwell_s = 0;      ///< at each stop
  double drift_m = 0;      ///< sd of the pose in x and y after 1 m, growing with its root
  double price_per_s = 0;  ///< nat that a second of flight must bring
  int horizon = 1;         ///< T
  double most_paths = 1;   ///< up to which all are tried
  int beam = 1;            ///< partial paths that are kept where they are not
};

struct Path {
  std::vector<int> stops;  ///< none: nothing is worth its time
  double gain = 0;         ///< nat, over all objects
  double detour_s = 0;     ///< with dwells and the way on, more than to go on at once
  double value = 0;        ///< gain − price · detour
};

struct PathChoice {
  Path best;
  double bound = 0;         ///< no path is worth more
  long paths = 0;           ///< of full length that were weighed
  bool exhaustive = false;  ///< all of them
};

/// P(a, T), or infinity where it exceeds a double's whole numbers.
[[nodiscard]] double variations(int a, int T);

/// The path of up to `horizon` stops with the highest value, of equals the shortest in time.
///
/// Where there are more than `most_paths`, a beam search; what it misses is bounded. Let S be any
/// set of stops. Gains without common part and drift (`Belief::most_gain`) are submodular, and both
/// only lower them, so for every path of k stops
///     gain ≤ gain(S) + (k highest single gains after S),   detour ≥ k · dwell,
/// the latter as flight times obey the triangle inequality (Nemhauser, Wolsey and Fisher,
/// Math. Programming 14, 1978). `bound` is the least of this over S = {} and S = the path found.
/// \param first  when given, the path begins there.
[[nodiscard]] PathChoice choose_path(const PathProblem& problem, std::optional<int> first = {});

/// What flying to all of `stops`, in this order, is worth.
[[nodiscard]] Path path_through(const PathProblem& problem, const std::vector<int>& stops);

/// The objects' beliefs after these stops.
[[nodiscard]] std::vector<Belief> after(const PathProblem& problem, const std::vector<int>& stops);

}  // namespace saker::active
