#include <gtest/gtest.h>

#include "made_vehicle.h"

namespace saker::simulation {
namespace {

constexpr double kStep = 0.002;
constexpr Time kStart = 1'000'000'000;

lidar::ImuSample reading(int i, const Eigen::Vector3d& force, const Eigen::Vector3d& rate) {
  return {kStart + i * from_seconds(kStep), force, rate};
}

TEST(InertialEstimator, LevelsItselfAndLearnsTheGyroscopesBias) {
  InertialEstimator estimator({});
  const Eigen::Vector3d bias(0.01, -0.008, 0);
  for (int i = 0; i < 120 * 500; ++i)
    estimator.propagate(reading(i, {0, 0, kStandardGravity}, bias), kStep);
  EXPECT_GT(estimator.attitude()(2, 2), std::cos(0.01));
  EXPECT_LT(estimator.angular_velocity().head<2>().norm(), 0.002);
}

TEST(InertialEstimator, HeightFollowsTheBarometerAndClimbTheAccelerometer) {
  InertialEstimator estimator({});
  double z = 5, v = 0;
  for (int i = 0; i < 20 * 500; ++i) {
    const double a = std::sin(i * kStep);
    z += kStep * v;
    v += kStep * a;
    estimator.propagate(reading(i, {0, 0, kStandardGravity + a}, {0, 0, 0}), kStep);
    if (i % 10 == 0) estimator.correct_height(z, 10 * kStep);
  }
  EXPECT_NEAR(estimator.height(), z, 0.05);
  EXPECT_NEAR(estimator.climb_rate(), v, 0.05);
}

VehicleOdometry odometry_at(int i, const Eigen::Vector3d& position,
                            const Eigen::Vector3d& velocity) {
  VehicleOdometry odometry;
  odometry.stamp = kStart + i * from_seconds(kStep);
  odometry.T_odom_body.translation() = position;
  odometry.velocity = velocity;
  odometry.status = VehicleOdometryStatus::ok;
  return odometry;
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

TEST(VehicleEstimator, OdometryThatIsLostOrOldIsNone) {
  VehicleEstimator estimator({});
  const auto run_to = [&](int from, int to) {
    for (int i = from; i < to; ++i)
      estimator.propagate(reading(i, {0, 0, kStandardGravity}, {0, 0, 0}), kStep);
  };
  run_to(0, 500);
  EXPECT_EQ(estimator.faults(), kNoOdometry);
  VehicleOdometry odometry = odometry_at(490, {0, 0, 0}, {0, 0, 0});
  odometry.status = VehicleOdometryStatus::lost;
  estimator.receive(odometry);
  EXPECT_EQ(estimator.faults(), kNoOdometry);
  odometry.status = VehicleOdometryStatus::ok;
  estimator.receive(odometry);
  EXPECT_TRUE(estimator.trusted());
  run_to(500, 800);
  EXPECT_EQ(estimator.faults(), kNoOdometry);
}

}  // namespace
}  // namespace saker::simulation
