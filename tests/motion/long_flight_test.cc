/// A goal 100 m away, a block of 40 m around the vehicle, known to 14 m: replanned every second.
#include <gtest/gtest.h>

#include "made_world.h"

namespace saker::motion {
namespace {

constexpr double kReplan_s = 1.0;
constexpr double kAhead_s = 0.6;  // the new plan begins where the committed one will be then
constexpr double kRange_m = 14;

/// 120 × 40 × 10 m with trunks, and walls across it with a gap on changing sides.
made::World long_world(std::uint64_t seed) {
  made::World world({-10, -20, 0}, {110, 20, 10});
  core::Rng rng(seed);
  for (int i = 0; i < 120; ++i) {
    const double x = rng.uniform(4, 96), y = rng.uniform(-19, 19);
    world.add(made::Cylinder{{x, y}, rng.uniform(0.1, 0.5)});
  }
  for (const double x : {20.0, 50.0, 80.0}) {
    const double side = rng.chance(0.5) ? 1 : -1;
    world.add(made::Box{{x, side > 0 ? -20.0 : -6.0, 0}, {x + 0.5, side > 0 ? 6.0 : 20.0, 10}});
  }
  return world;
}

/// What is known around `p`: nothing beyond the range.
std::shared_ptr<const occupancy::OccupancyGrid> seen_from(const occupancy::OccupancyGrid& all,
                                                          const Eigen::Vector3d& p) {
  auto block = std::make_shared<occupancy::OccupancyGrid>();
  block->resolution_m = all.resolution_m;
  block->origin =
      all.origin + all.resolution_m * (all.index_of(p).cast<double>() - Eigen::Vector3d(80, 80, 0));
  block->origin.z() = all.origin.z();
  block->size = {160, 160, 40};
  block->cells.assign(160 * 160 * 40, made::Cell::unknown);
  const int first = 80 - static_cast<int>(kRange_m / 0.25) - 1, last = 160 - first;
  for (int z = 0; z < 40; ++z)
    for (int y = first; y < last; ++y)
      for (int x = first; x < last; ++x) {
        const Eigen::Vector3d cell = block->centre_of({x, y, z});
        if ((cell - p).norm() < kRange_m) block->cells[block->offset({x, y, z})] = all.at(cell);
      }
  return block;
}

struct Flight {
  double seconds = 0;
  double path_m = 0;
  double clearance_m = INFINITY;
  int most_refused = 0;  // in a row
  Eigen::Vector3d end = Eigen::Vector3d::Constant(NAN);
};

/// Flies every plan exactly for a second, then the next.
Flight fly(const made::World& world, const Eigen::Vector3d& goal) {
  const MotionPlanner planner{MotionConfig{}};
  const auto all = world.grid();
  Flight flight;
  int refused = 0;
  Trajectory committed;
  committed.states = {made::resting_at({0, 0, 3})};
  committed.step_s = 1;
  Eigen::Vector3d here = committed.states[0].position;
  for (int k = 0; k < 150 && (here - goal).norm() > 0.5; ++k) {
    const Time now = from_seconds(k * kReplan_s);
    PlanRequest request;
    request.grid = seen_from(*all, committed.sample(now).position);
    request.start_time = now + from_seconds(kAhead_s);
    request.start = committed.sample(request.start_time);
    request.goal = goal;
    request.seed = static_cast<std::uint64_t>(k);
    const PlanResult result = planner.plan(request, core::Budget::iterations(4000));
    const Trajectory before = committed;
    if (result.status == PlanStatus::ok) committed = result.trajectory;
    refused = result.status == PlanStatus::ok ? 0 : refused + 1;
    flight.most_refused = std::max(flight.most_refused, refused);
    for (double s = 0; s < kReplan_s; s += 0.02) {
      const Time t = now + from_seconds(s);
      const Eigen::Vector3d p = (t < request.start_time ? before : committed).sample(t).position;
      flight.path_m += (p - here).norm();
      flight.clearance_m = std::min(flight.clearance_m, world.distance_m(p));
      here = p;
    }
    flight.seconds += kReplan_s;
  }
  flight.end = here;
  return flight;
}

TEST(LongFlight, ArrivesClearOfEverythingAtAGoodSpeed) {
  const Eigen::Vector3d goal(100, 0, 3);
  for (std::uint64_t seed = 0; seed < 2; ++seed) {
    SCOPED_TRACE(seed);
    const Flight flight = fly(long_world(seed), goal);
    EXPECT_LT((flight.end - goal).norm(), 0.5) << flight.end.transpose();
    EXPECT_GE(flight.clearance_m, ClearanceConfig{}.least_m() - 0.01);
    EXPECT_LT(flight.path_m, 160);
    EXPECT_GT(flight.path_m / flight.seconds, 1.2);
    EXPECT_LT(flight.most_refused, 3) << "in a row: another goal would be tried";
  }
}

}  // namespace
}  // namespace saker::motion
