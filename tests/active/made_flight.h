#pragma once

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "made_street.h"
#include "saker/active/active.h"

namespace saker::active::made {

inline bool everywhere(const Eigen::Vector3d&) { return true; }

const core::Budget kBudget = core::Budget::iterations(1000);

/// Policy `visit` as in the paper.
inline ActiveConfig visiting() {
  ActiveConfig config;
  config.policy = PolicyName::visit;
  return config;
}

/// Policy `visit` as a heuristic: two opposite sides, oblique where it can be.
inline ActiveConfig two_sided() {
  ActiveConfig config = visiting();
  config.visit_policy.sides = 2;
  config.visit_policy.oblique_worth_m = 10;
  return config;
}

/// A vehicle that flies straight to what the tour says, a decision a second.
struct Flight {
  explicit Flight(TargetTour made) : tour(std::move(made)) {}

  void map(const std::vector<objects::Cuboid>& cars) {
    input.map = std::make_shared<const objects::ObjectMap>(map_of(cars));
  }
  void see(const occupancy::OccupancyGrid& grid) { input.grid = shared(grid); }

  const ActivePlan& decide() {
    input.stamp += kNanosecondsPerSecond;
    input.T_world_body.translation() = body;
    plan = tour.plan(input, kBudget);
    if (plan.goal && (goals.empty() || goals.back().id != plan.goal->id)) {
      goals.push_back(*plan.goal);
    }
    flown.insert(flown.end(), plan.flown.begin(), plan.flown.end());
    return plan;
  }

  /// \return the decisions until the end; `most` when it did not come.
  int fly(int most) {
    for (int step = 0; step < most; ++step) {
      if (decide().status == ActiveStatus::finished) return step;
      const Eigen::Vector3d way = plan.goal->position - body;
      body += way * std::min(1.0, speed / std::max(way.norm(), 1e-9));
    }
    return most;
  }

  [[nodiscard]] const Target& target(int index) const { return tour.targets()[index]; }

  TargetTour tour;
  ActiveInput input;
  ActivePlan plan;
  Eigen::Vector3d body = {0, 0, 3};
  double speed = 2;
  std::vector<Viewpoint> goals;    ///< in their order
  std::vector<Expectation> flown;  ///< in their order
};

}  // namespace saker::active::made
