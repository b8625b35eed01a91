#include "tools/saker/mission/team_division.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <span>

#include "saker/active/tour/tour.h"
#include "saker/core/error.h"

namespace saker::tools {
namespace {

using Places = std::vector<Eigen::Vector3d>;

constexpr double kBeyondSite = 1000;  // m: where the outer strips end
constexpr int kKicks = 200;           // perturbations of a tour too long to be solved exactly
constexpr double kNever = std::numeric_limits<double>::infinity();

/// Numbers of the robots from low x to high x.
std::vector<std::size_t> along_x(const Places& takeoffs) {
  std::vector<std::size_t> order(takeoffs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return takeoffs[i].x(); });
  return order;
}

/// Least longest work of the first robots with the first targets, and where the last one's begin.
struct Best {
  double longest_m = kNever;
  std::size_t begin = 0;
};

/// Robots and targets from low x to high x. \return where each robot's targets begin, and the end.
std::vector<std::size_t> cuts(const Places& targets, const Places& takeoffs,
                              const DivisionConfig& config) {
  const std::size_t robots = takeoffs.size(), n = targets.size();
  std::vector<std::vector<Best>> best(robots + 1, std::vector<Best>(n + 1));
  best[0][0].longest_m = 0;
  for (std::size_t r = 1; r <= robots; ++r) {
    for (std::size_t begin = r - 1; begin < n; ++begin) {
      if (best[r - 1][begin].longest_m == kNever) continue;
      for (std::size_t end = begin + 1; end + robots <= n + r; ++end) {
        const Places own(targets.begin() + static_cast<std::ptrdiff_t>(begin),
                         targets.begin() + static_cast<std::ptrdiff_t>(end));
        const double work = expected_work_m(own, takeoffs[r - 1], config);
        const double longest = std::max(best[r - 1][begin].longest_m, work);
        if (longest < best[r][end].longest_m) best[r][end] = {longest, begin};
      }
    }
  }
  std::vector<std::size_t> at(robots + 1, n);
  for (std::size_t r = robots; r > 0; --r) at[r - 1] = best[r][at[r]].begin;
  return at;
}

std::vector<double> strip(double from_x, double to_x) {
  return {from_x, -kBeyondSite, to_x, -kBeyondSite, to_x, kBeyondSite, from_x, kBeyondSite};
}

}  // namespace

double expected_work_m(const Places& targets, const Eigen::Vector3d& takeoff,
                       const DivisionConfig& config) {
  const active::TourProblem problem = active::straight_lines(targets, takeoff, takeoff);
  const active::Tour tour = active::solve_tour(problem, {}, core::Budget::iterations(kKicks));
  return tour.length + config.target_m * static_cast<double>(targets.size());
}

std::vector<std::vector<double>> divided_lots(Places targets, const Places& takeoffs,
                                              const DivisionConfig& config) {
  if (targets.size() < takeoffs.size()) {
    throw Error(fmt::format("division.by_work: {} targets for {} robots, expected one each",
                            targets.size(), takeoffs.size()));
  }
  std::ranges::stable_sort(targets, {}, [](const Eigen::Vector3d& p) { return p.x(); });
  const std::vector<std::size_t> order = along_x(takeoffs);
  Places from;
  for (const std::size_t robot : order) from.push_back(takeoffs[robot]);
  const std::vector<std::size_t> at = cuts(targets, from, config);
  std::vector<double> borders = {-kBeyondSite};
  for (std::size_t r = 1; r < order.size(); ++r) {
    borders.push_back((targets[at[r] - 1].x() + targets[at[r]].x()) / 2);
  }
  borders.push_back(kBeyondSite);
  std::vector<std::vector<double>> lots(takeoffs.size());
  for (std::size_t r = 0; r < order.size(); ++r) lots[order[r]] = strip(borders[r], borders[r + 1]);
  return lots;
}

}  // namespace saker::tools
