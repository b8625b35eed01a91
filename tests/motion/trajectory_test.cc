#include "saker/motion/trajectory.h"

#include <gtest/gtest.h>

namespace saker::motion {
namespace {

/// p(t) = (t³, 1 − t², t) from t = 0 to 1 s in steps of 0.1 s: what a cubic must reproduce.
MotionState cubic(double t) {
  MotionState s;
  s.position = {t * t * t, 1 - t * t, t};
  s.velocity = {3 * t * t, -2 * t, 1};
  s.acceleration = {6 * t, -2, 0};
  s.yaw = wrapped(3 + t);  // passes ±π
  s.yaw_rate = 1;
  return s;
}

Trajectory made() {
  Trajectory trajectory{.id = 1, .start = from_seconds(10), .step_s = 0.1, .states = {}};
  for (int i = 0; i <= 10; ++i) trajectory.states.push_back(cubic(0.1 * i));
  return trajectory;
}

TEST(Trajectory, ReproducesACubicBetweenItsStates) {
  const Trajectory trajectory = made();
  for (const double t : {0.0, 0.013, 0.25, 0.5, 0.77, 0.999}) {
    const MotionState s = trajectory.sample(from_seconds(10 + t)), truth = cubic(t);
    EXPECT_TRUE(s.position.isApprox(truth.position, 1e-7)) << t;
    EXPECT_TRUE(s.velocity.isApprox(truth.velocity, 1e-7)) << t;
    EXPECT_TRUE(s.acceleration.isApprox(truth.acceleration, 1e-7)) << t;
    EXPECT_NEAR(wrapped(s.yaw - truth.yaw), 0, 1e-7) << t;
    EXPECT_NEAR(s.yaw_rate, 1, 1e-9);
  }
}

TEST(Trajectory, StaysAtItsFirstStateBeforeItsStart) {
  EXPECT_EQ(made().sample(0).position, cubic(0).position);
  EXPECT_EQ(made().sample(0).velocity, cubic(0).velocity);
}

TEST(Trajectory, RestsAtItsLastStateAfterItsEnd) {
  const MotionState s = made().sample(from_seconds(100));
  EXPECT_EQ(s.position, made().states.back().position);
  EXPECT_TRUE(s.velocity.isZero());
  EXPECT_TRUE(s.acceleration.isZero());
  EXPECT_EQ(s.yaw_rate, 0);
}

TEST(Trajectory, WithoutStatesGivesNothingFinite) {
  EXPECT_FALSE(Trajectory{}.sample(0).position.allFinite());
}

TEST(Trajectory, OfOneStateIsAPlace) {
  Trajectory trajectory{.id = 1, .start = 5, .step_s = 0.1, .states = {cubic(0.5)}};
  EXPECT_EQ(trajectory.end(), 5);
  EXPECT_EQ(trajectory.sample(0).position, cubic(0.5).position);
  EXPECT_EQ(trajectory.sample(9).position, cubic(0.5).position);
}

TEST(Wrapped, IsTheSameAngleWithinPi) {
  for (const double angle : {-9.0, -3.2, 0.0, 3.1, 3.2, 100.0}) {
    EXPECT_LE(std::abs(wrapped(angle)), M_PI + 1e-12);
    EXPECT_NEAR(std::sin(wrapped(angle)), std::sin(angle), 1e-12);
    EXPECT_NEAR(std::cos(wrapped(angle)), std::cos(angle), 1e-12);
  }
}

}  // namespace
}  // namespace saker::motion
