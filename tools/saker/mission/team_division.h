#pragma once

#include <Eigen/Core>
#include <vector>

#include "saker/core/config.h"

namespace saker::tools {

/// Whether lots are drawn by hand (each robot's `lot_m`) or by the work in them.
struct DivisionConfig {
  bool by_work = false;
  double target_m = 4;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("by_work", by_work, "",
            "lots are strips across x of base, drawn by what is said beforehand: the longest "
            "expected flight is as short as can be");
    v.field("target_m", target_m, {0, 100}, "m",
            "of way that a look at a target is worth: two seconds at 2 m/s");
  }
};

/// What a robot flies, as far as one can tell beforehand, m: there and back through all targets on
/// the shortest tour, and a look at each.
[[nodiscard]] double expected_work_m(const std::vector<Eigen::Vector3d>& targets,
                                     const Eigen::Vector3d& takeoff, const DivisionConfig& config);

/// A lot for each robot, corners x1, y1, x2, y2, …, in base: strips in the order of the take-offs'
/// x, borders half-way between neighbouring targets, at least one target in each. Of all such
/// divisions the one whose largest `expected_work_m` is least.
/// Throws Error when there are fewer targets than robots.
[[nodiscard]] std::vector<std::vector<double>> divided_lots(
    std::vector<Eigen::Vector3d> targets, const std::vector<Eigen::Vector3d>& takeoffs,
    const DivisionConfig& config);

}  // namespace saker::tools
