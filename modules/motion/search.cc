#include "saker/motion/search.h"

#include <ompl/base/ScopedState.h>
#include <ompl/base/goals/GoalState.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/datastructures/NearestNeighborsSqrtApprox.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>

#include <algorithm>
#include <memory>

#include "saker/motion/free_space.h"

namespace saker::motion {
namespace {

namespace ob = ompl::base;
using Space = ob::RealVectorStateSpace;

Eigen::Vector3d position_of(const ob::State* state) {
  return Eigen::Map<const Eigen::Vector3d>(state->as<Space::StateType>()->values);
}

void set_position(ob::State* state, const Eigen::Vector3d& p) {
  Eigen::Map<Eigen::Vector3d>(state->as<Space::StateType>()->values) = p;
}

class Validity : public ob::StateValidityChecker {
 public:
  Validity(const ob::SpaceInformationPtr& information, const FreeSpace& space)
      : ob::StateValidityChecker(information), space_(space) {}
  bool isValid(const ob::State* state) const override { return space_.free(position_of(state)); }

 private:
  const FreeSpace& space_;
};

class Motions : public ob::MotionValidator {
 public:
  Motions(const ob::SpaceInformationPtr& information, const FreeSpace& space)
      : ob::MotionValidator(information), space_(space) {}
  bool checkMotion(const ob::State* a, const ob::State* b) const override {
    return space_.free(position_of(a), position_of(b));
  }
  bool checkMotion(const ob::State* a, const ob::State* b,
                   std::pair<ob::State*, double>& last_valid) const override {
    last_valid.second = 0;  // RRT-Connect does not ask how far it could go
    return checkMotion(a, b);
  }

 private:
  const FreeSpace& space_;
};

/// Evenly in the reached cells, by our own generator: OMPL's are seeded from one global counter.
class ReachedSampler : public ob::StateSampler {
 public:
  ReachedSampler(const ob::StateSpace* state_space, const FreeSpace& space,
                 std::span<const int> reached, const core::Rng& rng)
      : ob::StateSampler(state_space), grid_(space.grid()), reached_(reached), rng_(rng) {}

  void sampleUniform(ob::State* state) override {
    const int offset =
        reached_[static_cast<std::size_t>(rng_.index(static_cast<int>(reached_.size())))];
    const int layer = grid_.size.x() * grid_.size.y();
    const Eigen::Vector3i cell(offset % grid_.size.x(), offset % layer / grid_.size.x(),
                               offset / layer);
    set_position(state, grid_.centre_of(cell) + jitter(0.5 * grid_.resolution_m));
  }
  void sampleUniformNear(ob::State* state, const ob::State* near, double distance) override {
    set_position(state, position_of(near) + jitter(distance));
  }
  void sampleGaussian(ob::State* state, const ob::State* mean, double sd) override {
    const Eigen::Vector3d offset(rng_.normal(0, sd), rng_.normal(0, sd), rng_.normal(0, sd));
    set_position(state, position_of(mean) + offset);
  }

 private:
  Eigen::Vector3d jitter(double most) {
    const double x = rng_.uniform(-most, most), y = rng_.uniform(-most, most);
    return {x, y, rng_.uniform(-most, most)};
  }

  const occupancy::OccupancyGrid& grid_;
  std::span<const int> reached_;
  core::Rng rng_;
};

ob::SpaceInformationPtr information_of(const FreeSpace& space) {
  const occupancy::OccupancyGrid& grid = space.grid();
  auto state_space = std::make_shared<Space>(3);
  ob::RealVectorBounds bounds(3);
  for (int axis = 0; axis < 3; ++axis) {
    bounds.setLow(axis, grid.origin[axis]);
    bounds.setHigh(axis, grid.origin[axis] + grid.resolution_m * grid.size[axis]);
  }
  state_space->setBounds(bounds);
  auto information = std::make_shared<ob::SpaceInformation>(state_space);
  information->setStateValidityChecker(std::make_shared<Validity>(information, space));
  information->setMotionValidator(std::make_shared<Motions>(information, space));
  return information;
}

/// One run of RRT-Connect; empty when it found nothing.
Waypoints connect(const ob::SpaceInformationPtr& information, const Eigen::Vector3d& start,
                  const Eigen::Vector3d& goal, double range_m,
                  const ob::PlannerTerminationCondition& enough) {
  ob::ScopedState<Space> from(information), to(information);
  set_position(from.get(), start);
  set_position(to.get(), goal);
  auto problem = std::make_shared<ob::ProblemDefinition>(information);
  problem->setStartAndGoalStates(from, to, 1e-6);

  ompl::geometric::RRTConnect planner(information);
  planner.setNearestNeighbors<ompl::NearestNeighborsSqrtApprox>();  // the default draws numbers
  planner.setRange(range_m);
  planner.setProblemDefinition(problem);
  if (planner.solve(enough) != ob::PlannerStatus::EXACT_SOLUTION) return {};
  Waypoints path;
  for (const ob::State* state :
       problem->getSolutionPath()->as<ompl::geometric::PathGeometric>()->getStates())
    path.push_back(position_of(state));
  return path;
}

}  // namespace

SearchResult search_path(const FreeSpace& space, std::span<const int> reached,
                         const Eigen::Vector3d& start, const Eigen::Vector3d& goal,
                         const SearchConfig& config, std::uint64_t seed,
                         const core::Budget& budget) {
  SearchResult best;
  const core::Rng random = core::Rng(seed).fork(0);
  for (int attempt = 0; attempt < config.attempts; ++attempt) {
    const core::Rng rng = random.fork(static_cast<std::uint64_t>(attempt));
    const ob::SpaceInformationPtr information = information_of(space);
    information->getStateSpace()->setStateSamplerAllocator([&](const ob::StateSpace* of) {
      return std::make_shared<ReachedSampler>(of, space, reached, rng.fork(0));
    });
    information->setup();
    // The attempts share the iterations: what an easy one leaves, the next may use.
    const int last = static_cast<int>(static_cast<std::int64_t>(budget.most_iterations()) *
                                      (attempt + 1) / config.attempts);
    const ob::PlannerTerminationCondition enough(
        [&] { return best.iterations >= last || budget.used_up(best.iterations++); });
    Waypoints path = connect(information, start, goal, config.range_m, enough);
    if (path.empty()) continue;
    path = shortened(path, space, config.shortcuts, rng.fork(1));
    if (best.path.empty() || length_m(path) < length_m(best.path)) best.path = std::move(path);
  }
  return best;
}

}  // namespace saker::motion
