/// Plans that begin in flight: no jump at the seam, limits and clearance everywhere.
#include <gtest/gtest.h>

#include "made_world.h"

namespace saker::motion {
namespace {

const MotionPlanner kPlanner{MotionConfig{}};
const MotionConfig kConfig;

/// The first plan's state after `after_s`, and the plan from there to another goal.
struct Replanned {
  Trajectory before;
  MotionState seam;
  PlanResult after;
};

Replanned replan(const made::World& world, const Eigen::Vector3d& start,
                 const Eigen::Vector3d& first_goal, double after_s,
                 const Eigen::Vector3d& second_goal) {
  const PlanResult first =
      kPlanner.plan(made::request(world, made::resting_at(start), first_goal), made::ample());
  const Time seam_time = first.trajectory.start + from_seconds(after_s);
  const MotionState seam = first.trajectory.sample(seam_time);
  PlanRequest again = made::request(world, seam, second_goal, 2);
  again.start_time = seam_time;
  return {first.trajectory, seam, kPlanner.plan(again, made::ample())};
}

void expect_no_jump(const Replanned& flight) {
  const MotionState first = flight.after.trajectory.sample(flight.after.trajectory.start);
  EXPECT_LT((first.position - flight.seam.position).norm(), 1e-9);
  EXPECT_LT((first.velocity - flight.seam.velocity).norm(), 1e-9);
  EXPECT_LT((first.acceleration - flight.seam.acceleration).norm(), 1e-9);
  EXPECT_NEAR(wrapped(first.yaw - flight.seam.yaw), 0, 1e-9);
  EXPECT_NEAR(first.yaw_rate, flight.seam.yaw_rate, 1e-9);
}

void expect_smooth(const Trajectory& t) {
  const LimitsConfig& limits = kConfig.limits;
  for (std::size_t k = 1; k < t.states.size(); ++k) {
    const MotionState &a = t.states[k - 1], &b = t.states[k];
    EXPECT_LE(b.velocity.norm(), 1.05 * limits.max_speed);
    EXPECT_LE(b.acceleration.norm(), 1.05 * limits.max_acceleration);
    EXPECT_LE((b.acceleration - a.acceleration).norm(), 1.1 * limits.max_jerk * t.step_s);
    const Eigen::Vector3d moved = 0.5 * t.step_s * (a.velocity + b.velocity);
    EXPECT_LT((b.position - a.position - moved).norm(), 3e-3) << "position follows velocity";
    const Eigen::Vector3d sped = 0.5 * t.step_s * (a.acceleration + b.acceleration);
    EXPECT_LT((b.velocity - a.velocity - sped).norm(), 1e-2) << "velocity follows acceleration";
  }
}

const made::World kFree({-20, -20, 0}, {20, 20, 10});

TEST(Replanning, JoinsWithoutAJumpInAnyDirectionAndAtAnyMoment) {
  for (const double after_s : {0.1, 0.35, 1.2, 3.0, 5.1, 30.0}) {
    for (int k = 0; k < 12; ++k) {
      SCOPED_TRACE(testing::Message() << after_s << " s, " << 30 * k << "°");
      const double heading = k * M_PI / 6;
      const Eigen::Vector3d goal(8 * std::cos(heading), 8 * std::sin(heading), 3.5 + 0.2 * k);
      const Replanned flight = replan(kFree, {-5, 0, 3}, {5, 0, 3}, after_s, goal);
      ASSERT_EQ(flight.after.status, PlanStatus::ok) << flight.after.reason;
      expect_no_jump(flight);
      expect_smooth(flight.after.trajectory);
      EXPECT_LT((flight.after.trajectory.states.back().position - goal).norm(), 1e-9);
    }
  }
}

TEST(Replanning, KeepsItsSpeedWhenTheGoalOnlyMovesOn) {
  const Replanned flight = replan(kFree, {-15, 0, 3}, {0, 0, 3}, 4, {15, 1, 3});
  ASSERT_EQ(flight.after.status, PlanStatus::ok) << flight.after.reason;
  const Trajectory& t = flight.after.trajectory;
  double slowest = INFINITY;
  for (double s = 0; s < 6; s += 0.1)
    slowest = std::min(slowest, t.sample(t.start + from_seconds(s)).velocity.norm());
  EXPECT_GT(slowest, 0.9 * flight.seam.velocity.norm());
}

TEST(Replanning, TheSamePlanFromItsMiddleEndsAsSoon) {
  const Replanned flight = replan(kFree, {-15, 0, 3}, {15, 0, 3}, 5, {15, 0, 3});
  EXPECT_NEAR(to_seconds(flight.after.trajectory.end() - flight.before.end()), 0, 0.5);
}

TEST(Replanning, TurnsBackByBrakingFirst) {
  const Replanned flight = replan(kFree, {-10, 0, 3}, {10, 0, 3}, 4, {-10, 0, 3});
  ASSERT_EQ(flight.after.status, PlanStatus::ok) << flight.after.reason;
  const double overshoot =
      made::greatest(flight.after.trajectory, [](const auto& s) { return s.position.x(); }) -
      flight.seam.position.x();
  const double speed = kConfig.limits.max_speed;
  EXPECT_GT(overshoot, 0.9 * speed * speed / (2 * kConfig.limits.max_acceleration));
  EXPECT_LT(overshoot, 2.5);
}

TEST(Replanning, RefusesWhereItCannotBrakeInTime) {
  made::World world({-20, -20, 0}, {20, 20, 10});
  world.add(made::Box{{1.5, -20, 0}, {2, 20, 10}});
  MotionState start = made::resting_at({0, 0, 3});
  start.velocity = {2.5, 0, 0};
  const PlanResult result = kPlanner.plan(made::request(world, start, {-5, 0, 3}), made::ample());
  EXPECT_EQ(result.status, PlanStatus::start_blocked) << result.reason;
}

TEST(Replanning, ThroughForestsStaysClearOfEveryTrunk) {
  int planned = 0, refused = 0;
  for (std::uint64_t seed = 0; seed < 15; ++seed) {
    SCOPED_TRACE(seed);
    const made::World world = made::forest(seed, 60);
    for (const double after_s : {3.0, 8.0, 13.0}) {
      const Replanned flight = replan(world, {-17, -17, 3}, {17, 17, 4}, after_s, {17, -17, 3});
      // A trunk straight ahead in a bend leaves no room to brake: the old trajectory is still good.
      if (flight.after.status == PlanStatus::start_blocked) ++refused;
      if (flight.after.status != PlanStatus::ok) continue;
      ++planned;
      expect_no_jump(flight);
      expect_smooth(flight.after.trajectory);
      EXPECT_LE(made::greatest(flight.after.trajectory,
                               [&](const auto& s) { return -world.distance_m(s.position); }),
                -kConfig.clearance.least_m() + 0.01);
    }
  }
  EXPECT_EQ(planned + refused, 45);
  EXPECT_LE(refused, 4);
}

}  // namespace
}  // namespace saker::motion
