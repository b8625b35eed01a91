#include "saker/active/tour/tour.h"

#include <algorithm>
#include <limits>

#include "saker/active/tour/local_search.h"

namespace saker::active {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Held and Karp: shortest[set][last] is the shortest way from the start through all stops of `set`
/// that ends at its member `last`.
class HeldKarp {
 public:
  explicit HeldKarp(const TourProblem& problem)
      : problem_(problem),
        stops_(static_cast<int>(problem.from_start.size())),
        shortest_(static_cast<std::size_t>(stops_) << stops_, kInfinity) {}

  [[nodiscard]] std::vector<int> solve() {
    for (int stop = 0; stop < stops_; ++stop) at(1 << stop, stop) = problem_.from_start[stop];
    for (int set = 1; set < 1 << stops_; ++set) extend(set);
    return trace();
  }

 private:
  [[nodiscard]] double& at(int set, int last) {
    return shortest_[static_cast<std::size_t>(set) * stops_ + last];
  }

  void extend(int set) {
    for (int last = 0; last < stops_; ++last) {
      const double length = at(set, last);
      if (length == kInfinity) continue;
      for (int next = 0; next < stops_; ++next) {
        if (set >> next & 1) continue;
        double& known = at(set | 1 << next, next);
        known = std::min(known, length + problem_.between(last, next));
      }
    }
  }

  /// From the last stop back: at each the predecessor that explains its length best.
  [[nodiscard]] std::vector<int> trace() {
    std::vector<int> order(stops_);
    Eigen::VectorXd onward = problem_.to_end;
    int set = (1 << stops_) - 1;
    for (int place = stops_ - 1; place >= 0; --place) {
      int best = -1;
      for (int stop = 0; stop < stops_; ++stop) {
        if (!(set >> stop & 1)) continue;
        if (best < 0 || at(set, stop) + onward[stop] < at(set, best) + onward[best]) best = stop;
      }
      order[place] = best;
      onward = problem_.between.col(best);
      set ^= 1 << best;
    }
    return order;
  }

  const TourProblem& problem_;
  int stops_;
  std::vector<double> shortest_;
};

std::vector<int> nearest_neighbour(const TourProblem& problem) {
  const int stops = static_cast<int>(problem.from_start.size());
  std::vector<bool> taken(stops, false);
  std::vector<int> order;
  Eigen::VectorXd from_here = problem.from_start;
  for (int place = 0; place < stops; ++place) {
    int nearest = -1;
    for (int stop = 0; stop < stops; ++stop) {
      if (!taken[stop] && (nearest < 0 || from_here[stop] < from_here[nearest])) nearest = stop;
    }
    taken[nearest] = true;
    order.push_back(nearest);
    from_here = problem.between.col(nearest);
  }
  return order;
}

}  // namespace

TourProblem straight_lines(std::span<const Eigen::Vector3d> stops, const Eigen::Vector3d& start,
                           const std::optional<Eigen::Vector3d>& end) {
  const int n = static_cast<int>(stops.size());
  TourProblem problem{Eigen::MatrixXd(n, n), Eigen::VectorXd(n), Eigen::VectorXd::Zero(n)};
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) problem.between(i, j) = (stops[i] - stops[j]).norm();
    problem.from_start[i] = (stops[i] - start).norm();
    if (end) problem.to_end[i] = (stops[i] - *end).norm();
  }
  return problem;
}

double length_of(const TourProblem& problem, std::span<const int> order) {
  if (order.empty()) return 0;
  double length = problem.from_start[order.front()] + problem.to_end[order.back()];
  for (std::size_t i = 1; i < order.size(); ++i) length += problem.between(order[i - 1], order[i]);
  return length;
}

Tour solve_tour(const TourProblem& problem, const TourConfig& config, const core::Budget& budget) {
  Tour tour;
  const int stops = static_cast<int>(problem.from_start.size());
  tour.exact = stops <= std::max(config.exact_up_to, 1);
  if (tour.exact) {
    if (stops > 0) tour.order = HeldKarp(problem).solve();
  } else {
    LocalSearch search(problem, nearest_neighbour(problem), config);
    search.descend();
    tour.kicks = search.perturb(config.kicks_per_stop * stops, budget);
    tour.order = search.order();
  }
  tour.length = length_of(problem, tour.order);
  return tour;
}

}  // namespace saker::active
