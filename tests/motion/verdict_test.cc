#include "saker/motion/verdict.h"

#include <gtest/gtest.h>

#include "saker/core/rng.h"

namespace saker::motion {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;
using occupancy::Cell;
using occupancy::OccupancyGrid;

/// Free from (-5, -5, -5) to (15, 5, 5).
OccupancyGrid free_grid() {
  OccupancyGrid grid;
  grid.resolution_m = 0.25;
  grid.origin = {-5, -5, -5};
  grid.size = {80, 40, 40};
  grid.cells.assign(static_cast<std::size_t>(grid.size.prod()), Cell::free);
  return grid;
}

void set(OccupancyGrid& grid, const Vector3d& p, Cell cell) {
  grid.cells[grid.offset(grid.index_of(p))] = cell;
}

/// Along x at constant speed, from t = 10 s on, then at rest.
Trajectory straight(double from, double to, double speed, double y = 0, double step_s = 0.5) {
  Trajectory trajectory;
  trajectory.id = 7;
  trajectory.start = from_seconds(10);
  trajectory.step_s = step_s;
  const int steps = static_cast<int>(std::ceil((to - from) / speed / step_s));
  for (int i = 0; i <= steps; ++i) {
    MotionState state;
    state.position = {std::min(to, from + i * step_s * speed), y, 0};
    state.velocity = {i < steps ? speed : 0, 0, 0};
    trajectory.states.push_back(state);
  }
  return trajectory;
}

const ClearanceConfig kClearance;  // 0.4 + 0.25 m
const Time kStart = from_seconds(10);

Verdict look(const Trajectory& trajectory, const OccupancyGrid& grid, Time now = kStart,
             const Exemption& exemption = {}) {
  return check(trajectory, now, grid, exemption, kClearance, {});
}

TEST(Verdict, APathThroughKnownFreeSpaceIsClearToItsEnd) {
  const Trajectory trajectory = straight(0, 10, 2);
  const Verdict verdict = look(trajectory, free_grid());
  EXPECT_TRUE(verdict.clear);
  EXPECT_EQ(verdict.reason, VerdictReason::none);
  EXPECT_EQ(verdict.trajectory_id, 7);
  EXPECT_EQ(verdict.stamp, kStart);
  EXPECT_EQ(verdict.clear_until, trajectory.end());
  EXPECT_TRUE(verdict.first_hit.hasNaN());
  EXPECT_NEAR(verdict.clearance_m, VerdictConfig{}.clearance_reach_m, 0.25);
}

TEST(Verdict, AnOccupiedCellOnThePathStopsItWhereTheMarginBegins) {
  OccupancyGrid grid = free_grid();
  set(grid, {8.1, 0.1, 0.1}, Cell::occupied);  // from x = 8
  const Trajectory trajectory = straight(0, 12, 2);
  const Verdict verdict = look(trajectory, grid);
  EXPECT_FALSE(verdict.clear);
  EXPECT_EQ(verdict.reason, VerdictReason::occupied);
  EXPECT_TRUE(verdict.first_hit.isApprox(Vector3d(8.125, 0.125, 0.125)));
  const double last = trajectory.sample(verdict.clear_until).position.x();
  EXPECT_LE(last, 8 - 0.65 + 1e-9);
  EXPECT_GE(last, 8 - 0.65 - 0.06);
}

TEST(Verdict, ACellIsPassedAtRadiusAndMarginButNotNearer) {
  OccupancyGrid grid = free_grid();
  set(grid, {5.1, 1.1, 0.1}, Cell::occupied);  // from y = 1
  const Verdict outside = look(straight(0, 10, 2, 1 - 0.66), grid);
  EXPECT_TRUE(outside.clear);
  const Verdict inside = look(straight(0, 10, 2, 1 - 0.64), grid);
  EXPECT_FALSE(inside.clear);
  EXPECT_NEAR(inside.clearance_m, 0.645, 0.01);
}

TEST(Verdict, ClearanceIsNeverMoreThanTheTruth) {
  core::Rng rng(1);
  for (int k = 0; k < 50; ++k) {
    OccupancyGrid grid = free_grid();
    const Vector3d p(rng.uniform(0, 10), rng.uniform(-3, 3), rng.uniform(-3, 3));
    set(grid, p, Cell::occupied);
    const Vector3d centre = grid.centre_of(grid.index_of(p));
    const Verdict verdict = look(straight(0, 10, 2), grid);
    const Vector3d nearest(centre.x(), 0, 0);
    const double truth = ((centre - nearest).cwiseAbs().array() - 0.125).max(0).matrix().norm();
    if (verdict.clear) {
      EXPECT_LE(verdict.clearance_m, truth + 1e-6);
      EXPECT_GE(verdict.clearance_m, std::min(truth, 3.0) - 0.44);
    } else {
      EXPECT_LT(truth, 0.65 + 1e-9);
    }
  }
}

TEST(Verdict, NoCellIsTooThinToBeSeenBetweenTwoLooks) {
  core::Rng rng(2);
  for (int k = 0; k < 200; ++k) {  // a fast trajectory in coarse steps, grazing the cell's corner
    OccupancyGrid grid = free_grid();
    set(grid, {rng.uniform(2, 8), 0.7, 0.1}, Cell::occupied);  // from y = 0.5
    EXPECT_FALSE(look(straight(0, 10, 8, 0.5 - 0.64, 1.0), grid).clear);
  }
}

TEST(Verdict, WhatWasNeverSeenIsNotFree) {
  OccupancyGrid grid = free_grid();
  set(grid, {6.1, 0.3, -0.2}, Cell::unknown);
  const Verdict verdict = look(straight(0, 10, 2), grid);
  EXPECT_FALSE(verdict.clear);
  EXPECT_EQ(verdict.reason, VerdictReason::unknown);
  EXPECT_TRUE(verdict.first_hit.isApprox(Vector3d(6.125, 0.375, -0.125)));
}

TEST(Verdict, OutsideOfTheGridNothingWasSeen) {
  const Trajectory trajectory = straight(0, 20, 2);
  const Verdict verdict = look(trajectory, free_grid());
  EXPECT_FALSE(verdict.clear);
  EXPECT_EQ(verdict.reason, VerdictReason::unknown);
  EXPECT_NEAR(trajectory.sample(verdict.clear_until).position.x(), 15 - 0.65, 0.06);
}

TEST(Verdict, TheTakeOffColumnAndTheVehiclesPlaceNeedNotHaveBeenSeen) {
  OccupancyGrid grid = free_grid();
  std::fill(grid.cells.begin(), grid.cells.end(), Cell::unknown);
  Exemption exemption;
  exemption.takeoff = {0, 0, -1};
  EXPECT_TRUE(look(straight(0, 1.5, 1), grid, kStart, exemption).clear);
  EXPECT_FALSE(look(straight(0, 3, 1), grid, kStart, exemption).clear);
  exemption = {};
  exemption.vehicle = {5, 0, 0};
  EXPECT_TRUE(look(straight(4.6, 5.4, 1), grid, kStart, exemption).clear);
  EXPECT_FALSE(look(straight(4.6, 7, 1), grid, kStart, exemption).clear);
}

TEST(Verdict, WhatIsOccupiedIsNotExempt) {
  OccupancyGrid grid = free_grid();
  set(grid, {1.1, 0.1, 0.1}, Cell::occupied);
  Exemption exemption;
  exemption.takeoff = {0, 0, -1};
  EXPECT_EQ(look(straight(0, 2, 1), grid, kStart, exemption).reason, VerdictReason::occupied);
}

TEST(Verdict, WhatLiesBehindIsNotLookedAt) {
  OccupancyGrid grid = free_grid();
  set(grid, {2.1, 0.1, 0.1}, Cell::occupied);
  const Trajectory trajectory = straight(0, 10, 2);
  EXPECT_FALSE(look(trajectory, grid).clear);
  EXPECT_TRUE(look(trajectory, grid, kStart + from_seconds(2)).clear);
}

TEST(Verdict, AfterItsEndThePlaceWhereItRestsIsLookedAt) {
  OccupancyGrid grid = free_grid();
  const Trajectory trajectory = straight(0, 10, 2);
  const Time later = trajectory.end() + from_seconds(60);
  EXPECT_TRUE(look(trajectory, grid, later).clear);
  set(grid, {10.3, 0.1, 0.1}, Cell::occupied);
  const Verdict verdict = look(trajectory, grid, later);
  EXPECT_FALSE(verdict.clear);
  EXPECT_EQ(verdict.clear_until, later);
}

TEST(Verdict, AVehicleNearerThanTheMarginMayLeaveButTouchNothing) {
  OccupancyGrid grid = free_grid();
  set(grid, {0.1, 0.6, 0.1}, Cell::occupied);  // from y = 0.5, the vehicle at y = 0
  Exemption exemption;
  exemption.vehicle = {0, 0, 0};
  EXPECT_TRUE(look(straight(0, 8, 1), grid, kStart, exemption).clear);
  EXPECT_FALSE(look(straight(-1, 8, 1, 0.2), grid, kStart, exemption).clear);
  set(grid, {5.1, 0.6, 0.1}, Cell::occupied);  // farther away the margin holds
  EXPECT_FALSE(look(straight(0, 8, 1), grid, kStart, exemption).clear);
}

TEST(Verdict, AVehicleInsideItsRadiusMayLeaveAndStayButNotComeNearer) {
  OccupancyGrid grid = free_grid();
  set(grid, {0.1, 0.35, 0.1}, Cell::occupied);  // from y = 0.25
  Exemption exemption;
  exemption.vehicle = {0, 0, 0};
  EXPECT_TRUE(look(straight(0, 8, 1), grid, kStart, exemption).clear);
  EXPECT_TRUE(look(straight(0, 0.01, 1), grid, kStart, exemption).clear) << "it stays";
  EXPECT_FALSE(look(straight(-1, 8, 1, 0.04), grid, kStart, exemption).clear);
  set(grid, {0.6, 0.6, 0.1}, Cell::occupied);  // another one, 0.5 m off the way
  EXPECT_TRUE(look(straight(0, 8, 1), grid, kStart, exemption).clear);
  set(grid, {0.6, 0.35, 0.1}, Cell::occupied);  // and one within the radius
  EXPECT_FALSE(look(straight(0, 8, 1), grid, kStart, exemption).clear);
}

TEST(Verdict, AVehicleBesideItsSetpointMayFollowATrajectoryThatLeaves) {
  OccupancyGrid grid = free_grid();
  set(grid, {0.1, 0.35, 0.1}, Cell::occupied);  // 0.25 m from where the trajectory begins
  Exemption exemption;
  exemption.vehicle = {0, -0.2, 0};
  EXPECT_TRUE(look(straight(0, 8, 1), grid, kStart, exemption).clear);
  EXPECT_FALSE(look(straight(0, 8, 1, 0.3), grid, kStart, exemption).clear) << "in touch";
}

TEST(Verdict, ATrajectoryThatWasNotLookedAtToItsEndIsNotClear) {
  VerdictConfig config;
  config.max_samples = 100;
  const Trajectory trajectory = straight(0, 10, 2);
  const Verdict verdict = check(trajectory, kStart, free_grid(), {}, kClearance, config);
  EXPECT_FALSE(verdict.clear);
  EXPECT_NEAR(trajectory.sample(verdict.clear_until).position.x(), 5, 0.3);
}

TEST(Verdict, WithoutATrajectoryThereIsNothingToFly) {
  const Verdict verdict = look({}, free_grid());
  EXPECT_FALSE(verdict.clear);
  EXPECT_EQ(verdict.reason, VerdictReason::no_trajectory);
}

TEST(Verdict, TheRemainingBoxHoldsEverythingFromNowOn) {
  Trajectory trajectory = straight(0, 10, 2);
  for (MotionState& state : trajectory.states) state.velocity.y() = 3;  // swings between states
  for (const double t : {0.0, 1.7, 4.9}) {
    const Time now = kStart + from_seconds(t);
    const Eigen::AlignedBox3d box = remaining_box(trajectory, now);
    for (Time time = now; time <= trajectory.end(); time += from_seconds(0.01))
      EXPECT_LE(box.exteriorDistance(trajectory.sample(time).position), 1e-9);
  }
  EXPECT_LT(remaining_box(trajectory, trajectory.end() + 1).volume(), 1e-9);
}

}  // namespace
}  // namespace saker::motion
