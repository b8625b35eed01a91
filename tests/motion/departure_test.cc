#include <gtest/gtest.h>

#include "made_world.h"
#include "saker/motion/verdict.h"

// A vehicle that stands nearer to something than its radius, as cells say it: planner and verdict
// let it leave, and it comes nearer to nothing that it is too near to.
namespace saker::motion {
namespace {

using Eigen::Vector3d;
using occupancy::OccupancyGrid;

const MotionPlanner kPlanner{MotionConfig{}};
const ClearanceConfig kClearance;
const Vector3d kHere(0, 0, 3);

/// Posts, and cells that were seen late within 0.7 m of the vehicle, which is not in one of them.
made::World crowded(std::uint64_t seed) {
  made::World world = made::forest(seed, 25);
  core::Rng rng(seed + 1000);
  const int cells = 1 + rng.index(4);
  for (int placed = 0; placed < cells;) {
    const double x = rng.uniform(-0.7, 0.7), y = rng.uniform(-0.7, 0.7);
    const Vector3d p = kHere + Vector3d(x, y, rng.uniform(-0.7, 0.7));
    const Vector3d low = 0.25 * (p / 0.25).array().floor().matrix();
    const made::Box cell{low, low + Vector3d::Constant(0.25)};
    if (cell.distance_m(kHere) < 0.05) continue;
    world.add(cell);
    ++placed;
  }
  return world;
}

std::vector<Eigen::Vector3i> cells_within_radius(const OccupancyGrid& grid, const Vector3d& p) {
  std::vector<Eigen::Vector3i> found;
  const Vector3d reach = Vector3d::Constant(kClearance.robot_radius_m);
  const Eigen::Vector3i low = grid.index_of(p - reach), high = grid.index_of(p + reach);
  for (int z = low.z(); z <= high.z(); ++z)
    for (int y = low.y(); y <= high.y(); ++y)
      for (int x = low.x(); x <= high.x(); ++x) {
        const Eigen::Vector3i index(x, y, z);
        if (grid.cells[grid.offset(index)] == occupancy::Cell::occupied &&
            grid.distance_m(index, p) < kClearance.robot_radius_m)
          found.push_back(index);
      }
  return found;
}

/// Follows a trajectory within 0.15 m until it is well away. \return whether the verdict was clear
/// at 5 Hz
bool clear_while_it_leaves(const Trajectory& trajectory, const OccupancyGrid& grid, core::Rng rng) {
  const Time away = trajectory.start + from_seconds(2.4);
  for (Time now = trajectory.start; now <= away; now += from_seconds(0.2)) {
    const double x = rng.uniform(-0.1, 0.1), y = rng.uniform(-0.1, 0.1);
    const Vector3d off(x, y, rng.uniform(-0.05, 0.05));
    Exemption exemption;
    exemption.vehicle = trajectory.sample(now).position + off;
    if (!check(trajectory, now, grid, exemption, kClearance, {}).clear) return false;
  }
  return true;
}

// Hazard: Surroundings | an obstacle is nearer than the radius | leaves without coming nearer to
//   any; lands where there is no such way | –
TEST(Departure, LeavesWhatIsNearerThanTheRadiusAndComesNearerToNothing) {
  int blocked = 0, left = 0, clear = 0;
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    const made::World world = crowded(seed);
    const auto grid = world.grid();
    const auto close = cells_within_radius(*grid, kHere);
    if (close.empty()) continue;
    ++blocked;
    const PlanResult result = kPlanner.plan(
        made::request(world, made::resting_at(kHere), {-17, -17, 3}, seed), made::ample());
    if (result.status != PlanStatus::ok) continue;
    ++left;
    for (const Eigen::Vector3i& cell : close) {
      const double now_m = grid->distance_m(cell, kHere);
      const double least_m = -made::greatest(result.trajectory, [&](const MotionState& s) {
        return -grid->distance_m(cell, s.position);
      });
      EXPECT_GE(least_m, now_m - ClearanceConfig::kAsNear_m) << "seed " << seed;
    }
    clear += clear_while_it_leaves(result.trajectory, *grid, core::Rng(seed)) ? 1 : 0;
  }
  EXPECT_GE(blocked, 12);
  EXPECT_GE(left, blocked * 9 / 10);
  EXPECT_GE(clear, left * 9 / 10);
  RecordProperty("blocked", blocked);
  RecordProperty("left", left);
  RecordProperty("clear", clear);
}

TEST(Departure, KeepsTheMarginAgainOutsideOfItsBall) {
  made::World world({-20, -20, 0}, {20, 20, 10});
  world.add(made::Box{{0.25, -5, 0}, {1, 5, 10}});
  const PlanResult result =
      kPlanner.plan(made::request(world, made::resting_at(kHere), {-8, 8, 3}), made::ample());
  ASSERT_EQ(result.status, PlanStatus::ok) << result.reason;
  for (const MotionState& state : result.trajectory.states) {
    if ((state.position - kHere).norm() < kClearance.vehicle_ball_m) continue;
    EXPECT_GE(world.distance_m(state.position), kClearance.least_m() - 1e-6);
  }
}

}  // namespace
}  // namespace saker::motion
