#include "saker/motion/braking.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace saker::motion {
namespace {

constexpr Time kMoment = 5 * kNanosecondsPerSecond;
constexpr double kStep_s = 0.001;

/// Along a circle of 4 m that climbs, at the speed 1.2 + sin(t) m/s: it speeds up and brakes.
Trajectory winding() {
  Trajectory trajectory;
  trajectory.start = 0;
  trajectory.step_s = 0.05;
  const double radius = 4, climb = 0.25;  // m; m a radian
  const double length = std::hypot(radius, climb);
  for (int i = 0; i <= 300; ++i) {
    const double t = 0.05 * i;
    const double angle = (1.2 * t + 1 - std::cos(t)) / length;
    const double rate = (1.2 + std::sin(t)) / length, change = std::cos(t) / length;
    const double c = std::cos(angle), s = std::sin(angle);
    const Eigen::Vector3d along(-radius * s, radius * c, climb),
        across(-radius * c, -radius * s, 0);
    trajectory.states.push_back({{radius * c, radius * s, 2 + climb * angle},
                                 rate * along,
                                 change * along + rate * rate * across,
                                 wrapped(angle + std::numbers::pi / 2),
                                 rate});
  }
  return trajectory;
}

/// A moment at which it speeds up, cruises and brakes.
class Braking : public testing::TestWithParam<double> {
 protected:
  [[nodiscard]] Time moment() const { return from_seconds(GetParam()); }

  const BrakingConfig config;
  const Trajectory trajectory = winding();
  const Trajectory stop = braked(trajectory, moment(), config);
};

TEST_P(Braking, BeginsAsTheTrajectoryIsAndEndsAtRest) {
  const MotionState planned = trajectory.sample(moment());
  const MotionState& begin = stop.states.front();
  EXPECT_EQ(stop.start, moment());
  EXPECT_LT((begin.position - planned.position).norm(), 1e-6);
  EXPECT_LT((begin.velocity - planned.velocity).norm(), 1e-6);
  EXPECT_LT((begin.acceleration - planned.acceleration).norm(), 1e-6);
  EXPECT_NEAR(begin.yaw_rate, planned.yaw_rate, 1e-9);
  const MotionState& end = stop.states.back();
  EXPECT_EQ(end.velocity.norm() + end.acceleration.norm() + std::abs(end.yaw_rate), 0);
}

TEST_P(Braking, StaysOnThePathThatWasChecked) {
  for (Time t = stop.start; t < stop.end(); t += from_seconds(kStep_s)) {
    const Eigen::Vector3d p = stop.sample(t).position;
    const double angle = (p.z() - 2) / 0.25;
    EXPECT_NEAR(p.head<2>().norm(), 4, 2e-3);
    EXPECT_NEAR(std::remainder(std::atan2(p.y(), p.x()) - angle, 2 * M_PI), 0, 5e-3);
  }
}

TEST_P(Braking, KeepsToItsDecelerationAndJerkAlongThePath) {
  const double step_s = stop.step_s;
  for (std::size_t i = 0; i + 1 < stop.states.size(); ++i) {
    const MotionState &a = stop.states[i], &b = stop.states[i + 1];
    const double slowing = (b.velocity.norm() - a.velocity.norm()) / step_s;
    EXPECT_GT(slowing, -config.deceleration_mps2 - 1e-6);
    const Eigen::Vector3d jerk = (b.acceleration - a.acceleration) / step_s;
    EXPECT_LT(jerk.norm(), config.jerk_mps3 + 3);  // and what bends the path
  }
}

TEST_P(Braking, SetpointsAreConsistent) {
  for (std::size_t i = 0; i + 1 < stop.states.size(); ++i) {
    const MotionState &a = stop.states[i], &b = stop.states[i + 1];
    const Eigen::Vector3d moved = (b.position - a.position) / stop.step_s;
    EXPECT_LT((moved - (a.velocity + b.velocity) / 2).norm(), 0.01);
    EXPECT_NEAR(wrapped(b.yaw - a.yaw) / stop.step_s, (a.yaw_rate + b.yaw_rate) / 2, 0.08);
  }
}

TEST_P(Braking, StandsWhereItSaidAndBeforeTheTrajectoryDoes) {
  const Time until = stands_at(trajectory, moment(), config);
  EXPECT_GE(until, moment());
  EXPECT_LT((trajectory.sample(until).position - stop.states.back().position).norm(), 2e-3);
}

INSTANTIATE_TEST_SUITE_P(Moments, Braking, testing::Values(0.0, 0.7, 1.6, 2.5, 3.2, 4.4, 9.0));

TEST(StopProfile, TakesTheTimeAndTheWayOfThreePhases) {
  BrakingConfig config;
  config.deceleration_mps2 = 2;
  config.jerk_mps3 = 10;
  const StopProfile cruise(2, 0, config);
  EXPECT_NEAR(cruise.duration_s(), 2.0 / 2 + 2.0 / 10, 1e-9);  // v/a + a/j
  EXPECT_NEAR(cruise.at(9).distance_m, 2 * cruise.duration_s() / 2, 1e-9);
  const StopProfile faster(2, 2, config);
  EXPECT_GT(faster.duration_s(), cruise.duration_s() + 0.2);
}

TEST(StopProfile, ASlowVehicleNeverBrakesAsHardAsItMay) {
  const BrakingConfig config;
  const StopProfile slow(0.05, 0, config);
  double hardest = 0;
  for (double t = 0; t < slow.duration_s(); t += kStep_s) {
    EXPECT_GE(slow.at(t).speed, 0);
    hardest = std::min(hardest, slow.at(t).acceleration);
  }
  EXPECT_NEAR(hardest, -std::sqrt(config.jerk_mps3 * 0.05), 0.05);
}

TEST(StopProfile, WhoIsAboutToStandGoesOnSo) {
  const StopProfile ending(0.02, -2, BrakingConfig());
  EXPECT_NEAR(ending.duration_s(), 2 * 0.02 / 2, 1e-9);
  EXPECT_NEAR(ending.at(0).acceleration, -2, 1e-9);
  EXPECT_NEAR(ending.at(ending.duration_s()).speed, 0, 1e-9);
}

TEST(BrakedTrajectory, WhatStandsStaysAndATurnEnds) {
  Trajectory turning;
  turning.start = 0;
  turning.step_s = 0.05;
  for (int i = 0; i < 200; ++i) {
    turning.states.push_back({{1, 2, 3}, {0, 0, 0}, {0, 0, 0}, 0.05 * i, 1});
  }
  const Trajectory stop = braked(turning, kMoment, BrakingConfig());
  EXPECT_EQ(stop.states.back().position, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(stop.states.back().yaw_rate, 0);
  EXPECT_NEAR(wrapped(stop.states.back().yaw - 5), 1 / (2 * std::numbers::pi), 1e-6);  // w²/2a
}

}  // namespace
}  // namespace saker::motion
