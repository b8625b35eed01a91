/// Random forests against their exact distances.
#include <gtest/gtest.h>

#include <cstring>

#include "made_world.h"
#include "saker/motion/verdict.h"

namespace saker::motion {
namespace {

const MotionPlanner kPlanner{MotionConfig{}};
const Eigen::Vector3d kStart(-17, -17, 3), kGoal(17, 17, 4);

PlanResult plan_through(const made::World& world, std::uint64_t seed) {
  return kPlanner.plan(made::request(world, made::resting_at(kStart), kGoal, seed), made::ample());
}

/// Every byte of every state.
bool same_bytes(const Trajectory& a, const Trajectory& b) {
  const auto same = [](const MotionState& s, const MotionState& t) {
    return std::memcmp(s.position.data(), t.position.data(), 24) == 0 &&
           std::memcmp(s.velocity.data(), t.velocity.data(), 24) == 0 &&
           std::memcmp(s.acceleration.data(), t.acceleration.data(), 24) == 0 &&
           std::memcmp(&s.yaw, &t.yaw, 8) == 0 && std::memcmp(&s.yaw_rate, &t.yaw_rate, 8) == 0;
  };
  return std::equal(a.states.begin(), a.states.end(), b.states.begin(), b.states.end(), same);
}

TEST(Forest, HundredOfThemAreFlownClearOfEveryTrunkAndWithinLimits) {
  const MotionConfig config;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    const made::World world = made::forest(seed, 60);
    const PlanResult result = plan_through(world, seed);
    ASSERT_EQ(result.status, PlanStatus::ok) << result.reason;
    EXPECT_FALSE(result.partial);
    const Trajectory& t = result.trajectory;
    EXPECT_LE(made::greatest(t, [&](const auto& s) { return -world.distance_m(s.position); }),
              -config.clearance.least_m() + 0.01);
    EXPECT_LE(made::greatest(t, [](const auto& s) { return s.velocity.norm(); }),
              1.01 * config.limits.max_speed);
    EXPECT_LE(made::greatest(t, [](const auto& s) { return std::abs(s.velocity.z()); }),
              1.01 * config.limits.max_climb_speed);
    EXPECT_LE(made::greatest(t, [](const auto& s) { return s.acceleration.norm(); }),
              1.03 * config.limits.max_acceleration);
    EXPECT_NEAR((t.states.back().position - kGoal).norm(), 0, 1e-9);
    EXPECT_TRUE(t.states.back().velocity.isZero());
  }
}

TEST(Forest, TheCollisionCheckerClearsWhatThePlannerMakes) {
  for (std::uint64_t seed = 0; seed < 15; ++seed) {
    SCOPED_TRACE(seed);
    const made::World world = made::forest(seed, seed % 2 == 0 ? 60 : 120);
    const PlanResult result = plan_through(world, seed);
    ASSERT_EQ(result.status, PlanStatus::ok) << result.reason;
    const Verdict verdict = check(result.trajectory, result.trajectory.start, *world.grid(),
                                  {.vehicle = kStart}, ClearanceConfig{}, VerdictConfig{});
    EXPECT_TRUE(verdict.clear) << verdict.first_hit.transpose();
  }
}

TEST(Forest, PathsAreLittleLongerThanTheStraightLine) {
  double sum = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed)
    sum += plan_through(made::forest(seed, 60), seed).diagnostics.path_m;
  EXPECT_LT(sum / 20, 1.05 * (kGoal - kStart).norm());
}

TEST(Forest, TheSameRequestGivesTheSameBytes) {
  const made::World world = made::forest(3, 100);
  const PlanResult first = plan_through(world, 3);
  static_cast<void>(plan_through(made::forest(4, 100), 4));  // other plans between change nothing
  const PlanResult second =
      MotionPlanner(MotionConfig{})
          .plan(made::request(world, made::resting_at(kStart), kGoal, 3), made::ample());
  ASSERT_EQ(first.status, PlanStatus::ok) << first.reason;
  ASSERT_GT(first.diagnostics.iterations, 0);
  EXPECT_TRUE(same_bytes(first.trajectory, second.trajectory));
  EXPECT_EQ(first.diagnostics.iterations, second.diagnostics.iterations);
}

TEST(Forest, AnotherSeedSearchesElsewhere) {
  const made::World world = made::forest(3, 100);
  const PlanResult one = plan_through(world, 3), other = plan_through(world, 4);
  ASSERT_EQ(one.status, PlanStatus::ok) << one.reason;
  EXPECT_FALSE(same_bytes(one.trajectory, other.trajectory));
}

}  // namespace
}  // namespace saker::motion
