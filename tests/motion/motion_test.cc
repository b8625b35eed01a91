#include "saker/motion/motion.h"

#include <gtest/gtest.h>

#include "made_world.h"
#include "saker/core/error.h"

namespace saker::motion {
namespace {

using made::Box;
using made::World;

const MotionPlanner kPlanner{MotionConfig{}};
const double kLeast_m = ClearanceConfig{}.least_m();

World free_block() { return World({-20, -20, 0}, {20, 20, 10}); }

PlanResult plan(const World& world, const MotionState& start, const Eigen::Vector3d& goal) {
  return kPlanner.plan(made::request(world, start, goal), made::ample());
}

PlanResult plan(const World& world, const Eigen::Vector3d& start, const Eigen::Vector3d& goal) {
  return plan(world, made::resting_at(start), goal);
}

double least_distance_m(const World& world, const Trajectory& trajectory) {
  return -made::greatest(trajectory,
                         [&](const MotionState& s) { return -world.distance_m(s.position); });
}

Eigen::Vector3d end_of(const PlanResult& result) {
  return result.trajectory.states.back().position;
}

TEST(MotionPlanner, FliesStraightThroughFreeSpace) {
  const PlanResult result = plan(free_block(), {-10, 0, 3}, {10, 5, 4});
  ASSERT_EQ(result.status, PlanStatus::ok) << result.reason;
  EXPECT_TRUE(result.diagnostics.straight);
  EXPECT_FALSE(result.partial);
  EXPECT_NEAR((end_of(result) - Eigen::Vector3d(10, 5, 4)).norm(), 0, 1e-9);
  EXPECT_NEAR(result.diagnostics.path_m, Eigen::Vector3d(20, 5, 1).norm(), 1e-6);
  EXPECT_EQ(result.trajectory.id, 7);
  EXPECT_EQ(result.trajectory.start, from_seconds(100));
}

TEST(MotionPlanner, TakesLittleLongerThanTheFastestMotion) {
  const LimitsConfig limits;
  const PlanResult result = plan(free_block(), {-10, 0, 3}, {10, 0, 3});
  const double fastest_s =
      20 / limits.max_speed + limits.max_speed / limits.max_acceleration + limits.smoothing_s();
  EXPECT_GE(result.trajectory.duration_s(), fastest_s - limits.step_s);
  EXPECT_LE(result.trajectory.duration_s(), fastest_s + 0.5);
}

TEST(MotionPlanner, EndsAtTheGoalsYaw) {
  PlanRequest request = made::request(free_block(), made::resting_at({0, 0, 3}, 1), {5, 0, 3});
  request.goal_yaw = 2.5;
  const PlanResult result = kPlanner.plan(request, made::ample());
  ASSERT_EQ(result.status, PlanStatus::ok);
  EXPECT_NEAR(result.trajectory.states.back().yaw, 2.5, 1e-6);
}

TEST(MotionPlanner, TurnsOnTheSpotWhenTheGoalIsWhereItIs) {
  PlanRequest request = made::request(free_block(), made::resting_at({1, 2, 3}), {1, 2, 3});
  request.goal_yaw = -2;
  const PlanResult result = kPlanner.plan(request, made::ample());
  ASSERT_EQ(result.status, PlanStatus::ok) << result.reason;
  EXPECT_NEAR(result.trajectory.states.back().yaw, -2, 1e-6);
  EXPECT_LT(made::greatest(result.trajectory, [](const auto& s) { return s.velocity.norm(); }),
            1e-9);
}

TEST(MotionPlanner, FindsTheGapInAWall) {
  World world = free_block();
  world.add(Box{{0, -20, 0}, {0.5, 6, 10}}).add(Box{{0, 8.5, 0}, {0.5, 20, 10}});
  const PlanResult result = plan(world, {-8, -5, 3}, {8, -5, 3});
  ASSERT_EQ(result.status, PlanStatus::ok) << result.reason;
  EXPECT_FALSE(result.diagnostics.straight);
  EXPECT_GE(least_distance_m(world, result.trajectory), kLeast_m - 0.01);
}

TEST(MotionPlanner, RefusesAGapNarrowerThanTheRobot) {
  World world = free_block();
  world.add(Box{{0, -20, 0}, {0.5, 6, 10}}).add(Box{{0, 7.25, 0}, {0.5, 20, 10}});
  EXPECT_EQ(plan(world, {-8, 6.5, 3}, {8, 6.5, 3}).status, PlanStatus::no_path);
}

TEST(MotionPlanner, FliesOverAWallThatIsLowerThanTheBand) {
  World world = free_block();
  world.add(Box{{0, -20, 0}, {0.5, 20, 6}});
  const PlanResult result = plan(world, {-8, 0, 3}, {8, 0, 3});
  ASSERT_EQ(result.status, PlanStatus::ok) << result.reason;
  EXPECT_GE(least_distance_m(world, result.trajectory), kLeast_m - 0.01);
}

TEST(MotionPlanner, KnowsThatAClosedRoomHasNoWayOut) {
  World world = free_block();
  world.add(Box{{-4, -4, 0}, {4, -3.5, 10}}).add(Box{{-4, 3.5, 0}, {4, 4, 10}});
  world.add(Box{{-4, -4, 0}, {-3.5, 4, 10}}).add(Box{{3.5, -4, 0}, {4, 4, 10}});
  const PlanResult result = plan(world, {0, 0, 3}, {10, 0, 3});
  EXPECT_EQ(result.status, PlanStatus::no_path);
  EXPECT_FALSE(result.reason.empty());
  EXPECT_TRUE(result.trajectory.empty());
}

TEST(MotionPlanner, LeavesAUTrap) {
  World world = free_block();
  world.add(Box{{5, -6, 0}, {5.5, 6, 10}});
  world.add(Box{{-5, -6, 0}, {5.5, -5.5, 10}}).add(Box{{-5, 5.5, 0}, {5.5, 6, 10}});
  const PlanResult result = plan(world, {3, 0, 3}, {10, 0, 3});
  ASSERT_EQ(result.status, PlanStatus::ok) << result.reason;
  EXPECT_FALSE(result.partial);
  EXPECT_GE(least_distance_m(world, result.trajectory), kLeast_m - 0.01);
  EXPECT_LT(result.diagnostics.path_m, 35);  // round one arm: about 32 m
}

TEST(MotionPlanner, DoesNotFlyIntoWhatWasNeverSeen) {
  World world = free_block();
  world.hide(Box{{5, -20, 0}, {20, 20, 10}});
  const PlanResult result = plan(world, {-5, 0, 3}, {15, 0, 3});
  ASSERT_EQ(result.status, PlanStatus::ok) << result.reason;
  EXPECT_TRUE(result.partial);
  EXPECT_GT(end_of(result).x(), 3.5);
  EXPECT_LT(made::greatest(result.trajectory, [](const auto& s) { return s.position.x(); }),
            5 - kLeast_m + 0.01);
}

TEST(MotionPlanner, FliesTowardsAGoalFarOutsideOfTheBlock) {
  const PlanResult result = plan(free_block(), {-10, 0, 3}, {90, 0, 3});
  ASSERT_EQ(result.status, PlanStatus::ok) << result.reason;
  EXPECT_TRUE(result.partial);
  EXPECT_GT(end_of(result).x(), 18.5);
  EXPECT_LT(std::abs(end_of(result).y()), 1);
}

TEST(MotionPlanner, GoesRoundAWallWhoseOtherSideItCannotSee) {
  World world = free_block();
  world.add(Box{{3, -6, 0}, {3.5, 8, 10}}).hide(Box{{3.5, -12, 0}, {20, 14, 10}});
  const PlanResult result = plan(world, {-3, 0, 3}, {12, 0, 3});
  ASSERT_EQ(result.status, PlanStatus::ok) << result.reason;
  EXPECT_TRUE(result.partial);
  EXPECT_LT(end_of(result).y(), -5) << "round the nearer end, not to the wall's face";
}

TEST(MotionPlanner, SaysWhenTheKnownFreeSpaceBringsItNoNearer) {
  World world = free_block();
  world.hide(Box{{0.8, -20, 0}, {20, 20, 10}});
  const PlanResult result = plan(world, {0, 0, 3}, {15, 0, 3});
  EXPECT_EQ(result.status, PlanStatus::no_progress) << result.reason;
}

TEST(MotionPlanner, MovesAGoalTooNearToAnObstacle) {
  World world = free_block();
  world.add(Box{{8, -20, 0}, {9, 20, 10}});
  const PlanResult result = plan(world, {0, 0, 3}, {7.8, 0, 3});
  ASSERT_EQ(result.status, PlanStatus::ok) << result.reason;
  EXPECT_FALSE(result.partial);
  EXPECT_LT((end_of(result) - Eigen::Vector3d(7.8, 0, 3)).norm(), 1);
}

TEST(MotionPlanner, RefusesAGoalDeepInAnObstacle) {
  World world = free_block();
  world.add(Box{{6, -4, 0}, {12, 4, 10}});
  EXPECT_EQ(plan(world, {0, 0, 3}, {9, 0, 3}).status, PlanStatus::goal_blocked);
}

TEST(MotionPlanner, RefusesAGoalOutsideOfTheGeofence) {
  EXPECT_EQ(plan(free_block(), {0, 0, 3}, {5, 0, 50}).status, PlanStatus::goal_outside);
}

TEST(MotionPlanner, StaysInsideTheGeofence) {
  MotionConfig config;
  config.geofence.polygon_m = {-15, -15, 15, -15, 15, 15, 5, 15, 5, 0, -5, 0, -5, 15, -15, 15};
  const MotionPlanner planner(config);
  const PlanResult result = planner.plan(
      made::request(free_block(), made::resting_at({-10, 10, 3}), {10, 10, 3}), made::ample());
  ASSERT_EQ(result.status, PlanStatus::ok) << result.reason;
  EXPECT_GE(
      -made::greatest(result.trajectory,
                      [&](const auto& s) { return -planner.geofence().inside_m(s.position); }),
      0);
}

TEST(MotionPlanner, RefusesAStartInTouchWithAnObstacle) {
  World world = free_block();
  world.add(Box{{-0.25, -5, 0}, {1, 5, 10}});
  EXPECT_EQ(plan(world, {-0.1, 0, 3}, {-8, 0, 3}).status, PlanStatus::start_blocked);
}

TEST(MotionPlanner, LeavesAPlaceInsideTheMarginOfAnObstacle) {
  World world = free_block();
  world.add(Box{{0.5, -5, 0}, {1, 5, 10}});
  const PlanResult result = plan(world, {0, 0, 3}, {-8, 3, 3});
  ASSERT_EQ(result.status, PlanStatus::ok) << result.reason;
  EXPECT_GE(least_distance_m(world, result.trajectory), ClearanceConfig{}.robot_radius_m);
}

TEST(MotionPlanner, LeavesTheTakeoffColumnButNotIntoTheUnknown) {
  World world = free_block();
  world.hide(Box{{-2.4, -2.4, 0}, {2.4, 2.4, 10}});  // under and over the sensor
  PlanRequest request = made::request(world, made::resting_at({0, 0, 3}), {10, 0, 3});
  EXPECT_EQ(kPlanner.plan(request, made::ample()).status, PlanStatus::no_progress)
      << "the ball around it is free, no more";
  request.takeoff = {0, 0, 0};
  EXPECT_EQ(kPlanner.plan(request, made::ample()).status, PlanStatus::ok);
}

TEST(MotionPlanner, RefusesRequestsThatMakeNoSense) {
  const World world = free_block();
  PlanRequest nowhere = made::request(world, made::resting_at({0, 0, 3}), {NAN, 0, 3});
  PlanRequest stateless = made::request(world, MotionState{}, {1, 0, 3});
  PlanRequest blind = made::request(world, made::resting_at({0, 0, 3}), {1, 0, 3});
  blind.grid = nullptr;
  PlanRequest wild = made::request(world, made::resting_at({0, 0, 3}), {1, 0, 3});
  wild.start.velocity = {9, 0, 0};
  for (const PlanRequest& bad : {nowhere, stateless, blind, wild}) {
    const PlanResult result = kPlanner.plan(bad, made::ample());
    EXPECT_EQ(result.status, PlanStatus::bad_request);
    EXPECT_FALSE(result.reason.empty());
  }
}

TEST(MotionPlanner, RefusesAStartOutsideOfTheBlock) {
  EXPECT_EQ(plan(free_block(), {50, 0, 3}, {0, 0, 3}).status, PlanStatus::start_blocked);
}

TEST(MotionPlanner, SaysWhenTheBudgetEndedFirst) {
  World world = free_block();
  world.add(Box{{0, -20, 0}, {0.5, 6, 10}}).add(Box{{0, 8.5, 0}, {0.5, 20, 10}});
  const PlanRequest request = made::request(world, made::resting_at({-8, -5, 3}), {8, -5, 3});
  EXPECT_EQ(kPlanner.plan(request, core::Budget::iterations(1)).status, PlanStatus::out_of_time);
}

TEST(MotionPlanner, RefusesAnInvalidConfiguration) {
  MotionConfig config;
  config.limits.max_speed = 0;
  EXPECT_THROW(MotionPlanner{config}, Error);
}

}  // namespace
}  // namespace saker::motion
