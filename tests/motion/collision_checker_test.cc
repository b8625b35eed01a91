#include "saker/motion/collision_checker.h"

#include <gtest/gtest.h>

#include "../occupancy/made_scan.h"
#include "saker/core/error.h"

namespace saker::motion {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr Time kPeriod = 100'000'000;

/// A hall: walls, floor and ceiling, so that every beam comes back.
made::BoxWorld hall() {
  made::BoxWorld world;
  const Vector3d low(-10, -8, 0), high(20, 8, 6);
  for (int axis = 0; axis < 3; ++axis) {
    Vector3d top = high, bottom = low;
    top[axis] = low[axis];
    bottom[axis] = high[axis];
    world.boxes.emplace_back(low - Vector3d::Constant(0.5), top + Vector3d::Constant(0.5));
    world.boxes.emplace_back(bottom - Vector3d::Constant(0.5), high + Vector3d::Constant(0.5));
    world.boxes[world.boxes.size() - 2].max()[axis] = low[axis];
    world.boxes.back().min()[axis] = high[axis];
  }
  return world;
}

made::BoxWorld hall_with_a_pillar() {
  made::BoxWorld world = hall();
  world.boxes.emplace_back(Vector3d(6, -0.4, 0), Vector3d(6.5, 0.4, 6));
  return world;
}

/// From x = 0 to 10 at 3 m height, 2 m/s.
Trajectory along_the_hall(std::int64_t id = 1) {
  Trajectory trajectory;
  trajectory.id = id;
  trajectory.start = kPeriod;
  trajectory.step_s = 0.5;
  for (int i = 0; i <= 10; ++i) {
    MotionState state;
    state.position = {i * 1.0, 0.1, 2.9};
    state.velocity = {i < 10 ? 2.0 : 0.0, 0, 0};
    trajectory.states.push_back(state);
  }
  return trajectory;
}

/// A vehicle that hovers at the beginning of that, and a checker.
class Hover {
 public:
  Hover() : checker_({}, {}) {
    EXPECT_EQ(checker_.set_trajectory(along_the_hall()), TrajectoryStatus::ok);
  }
  Verdict see(const made::BoxWorld& world) {
    made::Beams beams;
    beams.half_opening = 0.75;
    const SE3 T = made::pose({0.1, 0.1, 3.1}, 0.1);
    stamp_ += kPeriod;
    EXPECT_EQ(checker_.integrate(stamp_, T, made::scan(world, T, beams, rng_)).status,
              occupancy::InsertStatus::ok);
    return checker_.verdict(stamp_);
  }
  CollisionChecker& checker() { return checker_; }
  [[nodiscard]] Time stamp() const { return stamp_; }

 private:
  core::Rng rng_{1};
  CollisionChecker checker_;
  Time stamp_ = 0;
};

TEST(CollisionChecker, WhatTheScansHaveSeenToBeFreeIsClear) {
  Hover hover;
  Verdict verdict;
  for (int i = 0; i < 5; ++i) verdict = hover.see(hall());
  EXPECT_TRUE(verdict.clear) << to_string(verdict.reason) << verdict.first_hit.transpose();
  EXPECT_EQ(verdict.clear_until, along_the_hall().end());
  EXPECT_LE(verdict.clearance_m, 2.9);  // floor and ceiling, to the surfaces of their cells
  EXPECT_GE(verdict.clearance_m, 2.9 - 0.25 - 0.25 * std::sqrt(3));
}

TEST(CollisionChecker, ANewObstacleIsInTheNextScansVerdict) {
  Hover hover;
  for (int i = 0; i < 20; ++i) (void)hover.see(hall());
  const Verdict verdict = hover.see(hall_with_a_pillar());
  EXPECT_FALSE(verdict.clear);
  EXPECT_EQ(verdict.reason, VerdictReason::occupied);
  EXPECT_NEAR(verdict.first_hit.x(), 6, 0.3);
}

TEST(CollisionChecker, AnObstacleThatHasGoneIsForgottenWithinASecond) {
  Hover hover;
  for (int i = 0; i < 50; ++i) (void)hover.see(hall_with_a_pillar());
  int scans = 1;
  while (!hover.see(hall()).clear && scans < 50) ++scans;
  EXPECT_LE(scans, 10);
}

TEST(CollisionChecker, ItWaitsForTheFirstScanAndForTheFirstTrajectory) {
  CollisionChecker checker({}, {});
  EXPECT_EQ(checker.verdict(5).reason, VerdictReason::no_trajectory);
  EXPECT_TRUE(checker.grid().cells.empty());
  EXPECT_EQ(checker.set_trajectory(along_the_hall()), TrajectoryStatus::ok);
  const Verdict verdict = checker.verdict(5);
  EXPECT_EQ(verdict.reason, VerdictReason::stale_scan);
  EXPECT_EQ(verdict.clear_until, 5);
  EXPECT_FALSE(verdict.clear);
}

TEST(CollisionChecker, WithoutScansNothingStaysClear) {
  Hover hover;
  for (int i = 0; i < 5; ++i) (void)hover.see(hall());
  const Time stale = from_seconds(CollisionCheckerConfig{}.stale_after_s);
  EXPECT_TRUE(hover.checker().verdict(hover.stamp() + stale).clear);
  const Verdict verdict = hover.checker().verdict(hover.stamp() + stale + 1);
  EXPECT_FALSE(verdict.clear);
  EXPECT_EQ(verdict.reason, VerdictReason::stale_scan);
}

TEST(CollisionChecker, RefusedScansDoNotMakeTheMapFresh) {
  Hover hover;
  for (int i = 0; i < 5; ++i) (void)hover.see(hall());
  const Time later = hover.stamp() + from_seconds(10);
  const std::vector<Vector3f> points{{5, 0, 0}};
  EXPECT_EQ(hover.checker().integrate(later, made::pose({NAN, 0, 0}, 0), points).status,
            occupancy::InsertStatus::bad_pose);
  EXPECT_EQ(hover.checker().verdict(later).reason, VerdictReason::stale_scan);
}

TEST(CollisionChecker, MalformedAndOutdatedTrajectoriesAreRefusedAndTheLastOneStays) {
  CollisionChecker checker({}, {});
  EXPECT_EQ(checker.set_trajectory(along_the_hall(5)), TrajectoryStatus::ok);
  EXPECT_EQ(checker.set_trajectory(along_the_hall(4)), TrajectoryStatus::outdated);
  EXPECT_EQ(checker.set_trajectory({}), TrajectoryStatus::malformed);
  Trajectory broken = along_the_hall(6);
  broken.states[3].velocity.z() = NAN;
  EXPECT_EQ(checker.set_trajectory(broken), TrajectoryStatus::malformed);
  broken = along_the_hall(6);
  broken.states[3].position.x() = 1e30;
  EXPECT_EQ(checker.set_trajectory(broken), TrajectoryStatus::malformed);
  broken = along_the_hall(6);
  broken.step_s = 0;
  EXPECT_EQ(checker.set_trajectory(broken), TrajectoryStatus::malformed);
  EXPECT_EQ(checker.verdict(0).trajectory_id, 5);
}

TEST(CollisionChecker, ATrajectoryFarAwayIsNotClearAndCostsNoMemory) {
  Hover hover;
  (void)hover.see(hall());
  Trajectory far = along_the_hall(2);
  for (MotionState& state : far.states) state.position.x() += 5e5;
  EXPECT_EQ(hover.checker().set_trajectory(far), TrajectoryStatus::ok);
  EXPECT_EQ(hover.checker().verdict(hover.stamp()).reason, VerdictReason::unknown);
}

TEST(CollisionChecker, TheBlockLiesAroundTheVehicle) {
  Hover hover;
  (void)hover.see(hall());
  const occupancy::OccupancyGrid grid = hover.checker().grid();
  EXPECT_EQ(grid.stamp, hover.stamp());
  EXPECT_EQ(grid.size, Eigen::Vector3i(161, 161, 49));
  EXPECT_LE((grid.origin - Vector3d(-19.9, -19.9, -2.9)).cwiseAbs().maxCoeff(), 0.25);
  EXPECT_EQ(grid.at({2, 0.1, 3.1}), occupancy::Cell::free);
  EXPECT_EQ(grid.at({-10.1, 0.1, 3.1}), occupancy::Cell::occupied);
}

TEST(CollisionChecker, AConfigurationOutOfBoundsIsAnError) {
  CollisionCheckerConfig config;
  config.stale_after_s = -1;
  EXPECT_THROW(CollisionChecker(config, {}), Error);
  ClearanceConfig clearance;
  clearance.robot_radius_m = 0;
  EXPECT_THROW(CollisionChecker({}, clearance), Error);
}

}  // namespace
}  // namespace saker::motion
