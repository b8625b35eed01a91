#include "saker/simulation/vehicle/odometry_estimator.h"

#include <gtest/gtest.h>

#include <limits>

#include "readings.h"

namespace saker::simulation {
namespace {

const Eigen::Vector3d kZero = Eigen::Vector3d::Zero();

/// Stands for `seconds`; odometry at 100 Hz says `said` of each step. \return what was doubted
/// first, or null.
template <class Said>
OdometryDoubt stand(OdometryEstimator& estimator, double seconds, Said said) {
  for (int i = 0; i < steps_of(seconds); ++i) {
    estimator.propagate(reading(i, kRest, kZero), kStep);
    if (i % 5 != 0) continue;
    const VehicleOdometry odometry = said(i);
    if (!estimator.started()) estimator.restart(odometry);
    if (const OdometryDoubt doubt = estimator.correct(odometry)) return doubt;
  }
  return nullptr;
}

VehicleOdometry still(int step) { return odometry_at(step, {1, 2, 3}, kZero); }

TEST(OdometryEstimator, BeforeItStartsOdometryIsDoubted) {
  OdometryEstimator estimator({});
  EXPECT_STREQ(estimator.correct(still(0)), "no inertial readings yet");
  estimator.restart(still(0));
  EXPECT_FALSE(estimator.started()) << "there was no reading to start from";
}

TEST(OdometryEstimator, StartsWhereOdometrySaysItIs) {
  OdometryEstimator estimator({});
  estimator.propagate(reading(0, kRest, kZero), kStep);
  estimator.restart(odometry_at(0, {1, 2, 3}, {0.5, 0, 0}));
  EXPECT_TRUE(estimator.started());
  EXPECT_EQ(estimator.position(), Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(estimator.velocity(), Eigen::Vector3d(0.5, 0, 0));
}

TEST(OdometryEstimator, StandingStillItStaysThere) {
  OdometryEstimator estimator({});
  EXPECT_EQ(stand(estimator, 5, still), nullptr);
  EXPECT_LT((estimator.position() - Eigen::Vector3d(1, 2, 3)).norm(), 1e-9);
  EXPECT_LT(estimator.velocity().norm(), 1e-9);
}

TEST(OdometryEstimator, WithoutOdometryItFallsAsTheAccelerometerSays) {
  OdometryEstimator estimator({});
  estimator.propagate(reading(0, kRest, kZero), kStep);
  estimator.restart(odometry_at(0, kZero, kZero));
  for (int i = 1; i <= steps_of(1); ++i) estimator.propagate(reading(i, kZero, kZero), kStep);
  EXPECT_NEAR(estimator.position().z(), -0.5 * kStandardGravity, 0.02);
  EXPECT_NEAR(estimator.velocity().z(), -kStandardGravity, 0.02);
}

TEST(OdometryEstimator, AStepOfThePositionIsTakenOverInItsTime) {
  const OdometryEstimatorConfig config;
  OdometryEstimator estimator(config);
  EXPECT_EQ(stand(estimator, 1, still), nullptr);
  const int before = steps_of(1);
  const auto moved = [](int i) { return odometry_at(i, {1.1, 2, 3}, kZero); };
  for (int i = before; i < before + steps_of(config.position_time_s); ++i) {
    estimator.propagate(reading(i, kRest, kZero), kStep);
    if (i % 5 == 0) {
      EXPECT_EQ(estimator.correct(moved(i)), nullptr);
    }
  }
  EXPECT_NEAR(estimator.position().x(), 1 + 0.1 * (1 - std::exp(-1)), 0.01);
}

TEST(OdometryEstimator, ItLearnsTheGyroscopesBias) {
  OdometryEstimator estimator({});
  const Eigen::Vector3d bias(0.01, -0.02, 0.015);
  for (int i = 0; i < steps_of(60); ++i) {
    estimator.propagate(reading(i, kRest, bias), kStep);
    if (i % 5 != 0) continue;
    if (!estimator.started()) estimator.restart(still(i));
    EXPECT_EQ(estimator.correct(still(i)), nullptr);
  }
  EXPECT_LT(estimator.angular_velocity().norm(), 0.002);
}

TEST(OdometryEstimator, ItLearnsTheAccelerometersBias) {
  OdometryEstimator estimator({});
  for (int i = 0; i < steps_of(60); ++i) {
    estimator.propagate(reading(i, kRest + Eigen::Vector3d(0.1, 0, 0), kZero), kStep);
    if (i % 5 != 0) continue;
    if (!estimator.started()) estimator.restart(still(i));
    EXPECT_EQ(estimator.correct(still(i)), nullptr);
  }
  EXPECT_LT(estimator.velocity().norm(), 0.003);
}

/// What odometry says wrong from the second second on, and why it is doubted then.
struct Lie {
  const char* why;
  void (*tell)(VehicleOdometry&, double since);
};

const Lie kLies[] = {
    {"position jumps", [](VehicleOdometry& o, double) { o.T_odom_body.translation().x() += 1.0; }},
    {"velocity contradicts the accelerometer",
     [](VehicleOdometry& o, double) { o.velocity.y() = 1.2; }},
    {"attitude contradicts the gyroscope",
     [](VehicleOdometry& o, double) {
       o.T_odom_body.linear() = core::so3_exp({0, 0.3, 0}) * o.T_odom_body.linear();
     }},
    {"position drifts from its velocity",
     [](VehicleOdometry& o, double since) { o.T_odom_body.translation().x() += 0.7 * since; }},
    {"not finite",
     [](VehicleOdometry& o, double) { o.velocity.x() = std::numeric_limits<double>::quiet_NaN(); }},
};

TEST(OdometryEstimator, EachKindOfLieIsDoubtedForItsReason) {
  for (const Lie& lie : kLies) {
    OdometryEstimator estimator({});
    const OdometryDoubt doubt = stand(estimator, 10, [&](int i) {
      VehicleOdometry odometry = still(i);
      if (i >= steps_of(2)) lie.tell(odometry, (i - steps_of(2)) * kStep);
      return odometry;
    });
    EXPECT_STREQ(doubt, lie.why);
  }
}

TEST(OdometryEstimator, WhatIsDoubtedChangesNothing) {
  OdometryEstimator estimator({});
  EXPECT_EQ(stand(estimator, 1, still), nullptr);
  const int now = steps_of(1) - 1;
  EXPECT_NE(estimator.correct(odometry_at(now, {9, 9, 9}, kZero)), nullptr);
  EXPECT_LT((estimator.position() - Eigen::Vector3d(1, 2, 3)).norm(), 1e-9);
}

TEST(OdometryEstimator, ARestartElsewhereForgetsTheOldPlace) {
  OdometryEstimator estimator({});
  EXPECT_EQ(stand(estimator, 1, still), nullptr);
  const int now = steps_of(1) - 1;
  estimator.restart(odometry_at(now, {50, 60, 70}, kZero));
  EXPECT_LT((estimator.position() - Eigen::Vector3d(50, 60, 70)).norm(), 1e-9);
  EXPECT_EQ(estimator.correct(odometry_at(now, {50, 60, 70}, kZero)), nullptr);
}

/// Readings since the odometry's stamp are propagated on from it.
TEST(OdometryEstimator, ALateRestartIsBroughtUpToNow) {
  OdometryEstimator estimator({});
  for (int i = 0; i <= steps_of(0.2); ++i) estimator.propagate(reading(i, kRest, kZero), kStep);
  estimator.restart(odometry_at(0, kZero, {2, 0, 0}));
  EXPECT_NEAR(estimator.position().x(), 2 * 0.2, 1e-6);
}

TEST(OdometryEstimator, TakingBackWithoutReadingsIsNoError) {
  OdometryEstimator estimator({});
  estimator.take_back();
  EXPECT_FALSE(estimator.started());
}

/// Accelerates by 0.5 m/s² along x; odometry is 0.1 s late.
TEST(OdometryEstimator, LatencyCostsNothing) {
  OdometryEstimator estimator({});
  constexpr int kLate = 50;
  const auto x = [](int i) { return 0.25 * i * kStep * i * kStep; };
  const auto v = [](int i) { return 0.5 * i * kStep; };
  for (int i = 0; i < 2000; ++i) {
    estimator.propagate(reading(i, {0.5, 0, kStandardGravity}, {0, 0, 0}), kStep);
    const int then = i - kLate;
    if (then < 0 || then % 5 != 0) continue;
    const VehicleOdometry odometry = odometry_at(then, {x(then), 0, 0}, {v(then), 0, 0});
    if (!estimator.started()) estimator.restart(odometry);
    EXPECT_EQ(estimator.correct(odometry), nullptr);
  }
  EXPECT_NEAR(estimator.position().x(), x(1999), 0.01);
  EXPECT_NEAR(estimator.velocity().x(), v(1999), 0.01);
}

/// Flies at 2 m/s; odometry freezes 0.6 s before the end, and is believed for a while.
TEST(OdometryEstimator, WhatALieDidIsUndoneByTakingItBack) {
  OdometryEstimator estimator({});
  constexpr int kEnd = 2000, kFrozen = kEnd - 300;
  for (int i = 0; i < kEnd; ++i) {
    estimator.propagate(reading(i, {0, 0, kStandardGravity}, {0, 0, 0}), kStep);
    if (i % 5 != 0) continue;
    const double said = 2 * std::min(i, kFrozen) * kStep;
    const VehicleOdometry odometry = odometry_at(i, {said, 0, 0}, {i < kFrozen ? 2.0 : 1.2, 0, 0});
    if (!estimator.started()) estimator.restart(odometry);
    (void)estimator.correct(odometry);
  }
  EXPECT_LT(estimator.velocity().x(), 1.8);
  estimator.take_back();
  EXPECT_NEAR(estimator.velocity().x(), 2, 0.01);
  EXPECT_NEAR(estimator.position().x(), 2 * (kEnd - 1) * kStep, 0.02);
}

TEST(OdometryEstimator, AVelocityThatTheAccelerometerDidNotSeeIsDoubted) {
  OdometryEstimator estimator({});
  OdometryDoubt doubt = nullptr;
  for (int i = 0; i < 1000 && doubt == nullptr; ++i) {
    estimator.propagate(reading(i, {0, 0, kStandardGravity}, {0, 0, 0}), kStep);
    if (i % 5 != 0) continue;
    const double t = i * kStep;
    const VehicleOdometry odometry = odometry_at(i, {0.5 * t * t, 0, 0}, {t, 0, 0});
    if (!estimator.started()) estimator.restart(odometry);
    doubt = estimator.correct(odometry);
  }
  EXPECT_NE(doubt, nullptr);
}

}  // namespace
}  // namespace saker::simulation
