#include "motion/stopping.h"

#include <gtest/gtest.h>

#include "core/rng.h"
#include "made_world.h"

namespace saker::motion {
namespace {

const LimitsConfig kLimits;

Eigen::Vector3d random_vector(core::Rng& rng, double most) {
  Eigen::Vector3d v(rng.normal(), rng.normal(), rng.normal());
  return rng.uniform(0, most) * v.normalized();
}

MotionState random_state(core::Rng& rng) {
  return {random_vector(rng, 20), random_vector(rng, kLimits.max_speed),
          random_vector(rng, kLimits.max_acceleration), rng.uniform(-3, 3), rng.uniform(-1, 1)};
}

TEST(StoppingTrajectory, BeginsAtTheStateAndEndsAtRest) {
  core::Rng rng(1);
  for (int i = 0; i < 100; ++i) {
    const MotionState start = random_state(rng);
    const Trajectory stop = stopping_trajectory(start, 5, kLimits);
    const MotionState first = stop.states.front(), last = stop.states.back();
    EXPECT_EQ(stop.start, 5);
    EXPECT_EQ(first.position, start.position);
    EXPECT_EQ(first.velocity, start.velocity);
    EXPECT_TRUE(first.acceleration.isApprox(start.acceleration, 1e-12));
    EXPECT_NEAR(first.yaw, start.yaw, 1e-12);
    EXPECT_TRUE(last.velocity.isZero());
    EXPECT_TRUE(last.acceleration.isZero());
    EXPECT_EQ(last.yaw_rate, 0);
  }
}

TEST(StoppingTrajectory, KeepsAccelerationAndJerkWithinLimits) {
  core::Rng rng(2);
  for (int i = 0; i < 100; ++i) {
    const Trajectory stop = stopping_trajectory(random_state(rng), 0, kLimits);
    for (std::size_t k = 1; k < stop.states.size(); ++k) {
      const Eigen::Vector3d& a = stop.states[k].acceleration;
      const Eigen::Vector3d jerk = (a - stop.states[k - 1].acceleration) / stop.step_s;
      EXPECT_LE(a.norm(), kLimits.max_acceleration + 1e-9);
      EXPECT_LE(jerk.norm(), kLimits.max_jerk + 1e-9);
    }
  }
}

TEST(StoppingTrajectory, ItsStatesAreTheIntegralsOfOneAnother) {
  core::Rng rng(3);
  for (int i = 0; i < 100; ++i) {
    const Trajectory stop = stopping_trajectory(random_state(rng), 0, kLimits);
    for (std::size_t k = 1; k < stop.states.size(); ++k) {
      const MotionState &a = stop.states[k - 1], &b = stop.states[k];
      const Eigen::Vector3d moved = 0.5 * stop.step_s * (a.velocity + b.velocity);
      const Eigen::Vector3d sped = 0.5 * stop.step_s * (a.acceleration + b.acceleration);
      EXPECT_LT((b.position - a.position - moved).norm(), 1e-3);
      EXPECT_LT((b.velocity - a.velocity - sped).norm(), 5e-3);
    }
  }
}

TEST(StoppingTrajectory, StopsWithinTheShortestTimeOfAnyTrapezoid) {
  MotionState start = made::resting_at({0, 0, 3});
  start.velocity = {2, 0, 0};
  const Trajectory stop = stopping_trajectory(start, 0, kLimits);
  const double shortest_s = 2 / kLimits.max_acceleration + kLimits.smoothing_s();
  EXPECT_NEAR(stop.duration_s(), shortest_s, kLimits.step_s);
  EXPECT_NEAR(stop.states.back().position.x(), 2 * shortest_s / 2, 1e-9);
}

TEST(StoppingTrajectory, OfOneAtRestStaysThere) {
  const Trajectory stop = stopping_trajectory(made::resting_at({1, 2, 3}), 0, kLimits);
  for (const MotionState& s : stop.states) EXPECT_EQ(s.position, Eigen::Vector3d(1, 2, 3));
}

TEST(StoppingTrajectory, RefusesWhatIsNoStateOfAVehicle) {
  MotionState wild = made::resting_at({0, 0, 0});
  wild.velocity.x() = 1e6;
  EXPECT_TRUE(stopping_trajectory(wild, 0, kLimits).empty());
  EXPECT_TRUE(stopping_trajectory(MotionState{}, 0, kLimits).empty());
}

}  // namespace
}  // namespace saker::motion
