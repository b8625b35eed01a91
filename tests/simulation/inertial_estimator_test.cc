#include "saker/simulation/vehicle/inertial_estimator.h"

#include <gtest/gtest.h>

#include "drawn.h"
#include "readings.h"
#include "saker/core/error.h"

namespace saker::simulation {
namespace {

/// Readings of a unit that stands tilted by `R` for `seconds`.
void stand(InertialEstimator& estimator, const Eigen::Matrix3d& R, double seconds) {
  const Eigen::Vector3d force = R.transpose() * kRest;
  for (int i = 0; i < steps_of(seconds); ++i)
    estimator.propagate(reading(i, force, Eigen::Vector3d::Zero()), kStep);
}

TEST(InertialEstimator, IsNotReadyBeforeItHasReadingsAndAHeight) {
  InertialEstimator estimator({});
  EXPECT_FALSE(estimator.ready());
  stand(estimator, Eigen::Matrix3d::Identity(), 0.1);
  EXPECT_FALSE(estimator.ready());
  estimator.correct_height(5, 0.02);
  EXPECT_TRUE(estimator.ready());
}

TEST(InertialEstimator, FindsTheVerticalOfATiltedUnitAtOnce) {
  core::Rng rng(4);
  for (int k = 0; k < 20; ++k) {
    const Eigen::Matrix3d R = core::so3_exp({rng.normal(0, 0.5), rng.normal(0, 0.5), 0});
    InertialEstimator estimator({});
    stand(estimator, R, 0.05);
    EXPECT_NEAR(estimator.attitude().row(2).dot(R.row(2)), 1, 1e-6);
  }
}

TEST(InertialEstimator, ItsAttitudeStaysARotation) {
  InertialEstimator estimator({});
  core::Rng rng(8);
  for (int i = 0; i < 5000; ++i) {
    const Eigen::Vector3d rate(rng.normal(), rng.normal(), rng.normal());
    estimator.propagate(reading(i, kRest, rate), kStep);
  }
  const Eigen::Matrix3d& R = estimator.attitude();
  EXPECT_LT((R.transpose() * R - Eigen::Matrix3d::Identity()).norm(), 1e-9);
}

TEST(InertialEstimator, TurnsWithTheGyroscope) {
  InertialEstimator estimator({});
  for (int i = 0; i < steps_of(1); ++i) estimator.propagate(reading(i, kRest, {0, 0, 0.5}), kStep);
  EXPECT_NEAR(core::yaw(estimator.attitude()), 0.5, 0.01);
}

/// Accelerations that are far from 1 g say nothing of the vertical.
TEST(InertialEstimator, AHardPullDoesNotTiltIt) {
  InertialEstimator estimator({});
  stand(estimator, Eigen::Matrix3d::Identity(), 5);
  const Eigen::Vector3d pulled(12, 0, kStandardGravity);
  for (int i = 0; i < steps_of(2); ++i)
    estimator.propagate(reading(i, pulled, Eigen::Vector3d::Zero()), kStep);
  EXPECT_GT(estimator.attitude()(2, 2), std::cos(0.01));
}

TEST(InertialEstimator, TheFirstBarometerReadingIsItsHeight) {
  InertialEstimator estimator({});
  estimator.correct_height(123.4, 0.02);
  EXPECT_DOUBLE_EQ(estimator.height(), 123.4);
  EXPECT_EQ(estimator.climb_rate(), 0);
}

TEST(InertialEstimator, StandingStillItsHeightStays) {
  InertialEstimator estimator({});
  estimator.correct_height(10, 0.02);
  stand(estimator, Eigen::Matrix3d::Identity(), 10);
  EXPECT_NEAR(estimator.height(), 10, 1e-6);
}

TEST(InertialEstimator, AStepOfTheBarometerIsFollowedWithinThreeOfItsTimes) {
  const InertialEstimatorConfig config;
  InertialEstimator estimator(config);
  estimator.correct_height(10, 0.02);
  const auto follow = [&](double seconds) {
    for (int i = 0; i < steps_of(seconds); ++i) {
      estimator.propagate(reading(i, kRest, Eigen::Vector3d::Zero()), kStep);
      if (i % 10 == 0) estimator.correct_height(11, 10 * kStep);
    }
  };
  follow(0.1);
  EXPECT_LT(estimator.height(), 10.5);
  follow(12 * config.height_time_s);
  EXPECT_NEAR(estimator.height(), 11, 0.02);
  EXPECT_NEAR(estimator.climb_rate(), 0, 0.02);
}

/// The observer has an integral: a constant error of the accelerometer costs no height in the end.
TEST(InertialEstimator, AnErrorOfTheAccelerometerIsLearned) {
  InertialEstimator estimator({});
  estimator.correct_height(5, 0.02);
  const Eigen::Vector3d wrong = kRest + Eigen::Vector3d(0, 0, 0.2);
  for (int i = 0; i < steps_of(40); ++i) {
    estimator.propagate(reading(i, wrong, Eigen::Vector3d::Zero()), kStep);
    if (i % 10 == 0) estimator.correct_height(5, 10 * kStep);
  }
  EXPECT_NEAR(estimator.height(), 5, 0.02);
  EXPECT_NEAR(estimator.climb_rate(), 0, 0.02);
}

TEST(InertialEstimator, ItsHeightIsSmootherThanTheBarometers) {
  InertialEstimator estimator({});
  core::Rng rng(5);
  Spread barometer, height;
  for (int i = 0; i < steps_of(60); ++i) {
    estimator.propagate(reading(i, kRest, Eigen::Vector3d::Zero()), kStep);
    if (i % 10 != 0) continue;
    const double read = 20 + rng.normal(0, 0.1);
    estimator.correct_height(read, 10 * kStep);
    if (i < steps_of(20)) continue;
    barometer.add(read);
    height.add(estimator.height());
  }
  EXPECT_NEAR(height.mean(), 20, 0.02);
  EXPECT_LT(height.sd(), 0.4 * barometer.sd());
}

TEST(InertialEstimator, ATimeOutOfItsBoundsIsRefusedByName) {
  try {
    InertialEstimator({.height_time_s = 0});
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("inertial.height_time_s"), std::string::npos);
  }
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

}  // namespace
}  // namespace saker::simulation
