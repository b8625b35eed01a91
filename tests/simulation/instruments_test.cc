#include "saker/simulation/vehicle/instruments.h"

#include <gtest/gtest.h>

#include "readings.h"
#include "saker/core/se3.h"

namespace saker::simulation {
namespace {

/// It turns about z at 2 rad/s: a unit 0.3 m ahead is pulled inwards by ω² r.
TEST(InertialUnit, ItsPlaceOnTheBodyIsFelt) {
  InertialUnit imu(kExact, {0.3, 0, 0}, Eigen::Matrix3d::Identity(), core::Rng(1));
  RigidState state;
  state.angular_velocity = {0, 0, 2};
  state.angular_acceleration = {0, 0, 5};
  const lidar::ImuSample sample = imu.sample(state, 7);
  EXPECT_LT((sample.acceleration - Eigen::Vector3d(-1.2, 1.5, kStandardGravity)).norm(), 1e-12);
  EXPECT_EQ(sample.stamp, 7);
}

TEST(InertialUnit, ReadingsAreInTheAxesThatAreAskedFor) {
  Eigen::Matrix3d R;
  R = Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ());
  InertialUnit imu(kExact, Eigen::Vector3d::Zero(), R, core::Rng(1));
  RigidState state;
  state.angular_velocity = {1, 0, 0};
  EXPECT_LT((imu.sample(state, 0).angular_velocity - Eigen::Vector3d(0, 1, 0)).norm(), 1e-12);
}

TEST(InertialUnit, NoiseAndBiasHaveTheConfiguredSpread) {
  ImuConfig config = kExact;
  config.acceleration_noise = 0.1;
  config.rotation_bias = 0.01;
  double squares = 0, bias_squares = 0;
  constexpr int kUnits = 300;
  for (int i = 0; i < kUnits; ++i) {
    InertialUnit imu(config, Eigen::Vector3d::Zero(), Eigen::Matrix3d::Identity(),
                     core::Rng(static_cast<std::uint64_t>(i)));
    const lidar::ImuSample a = imu.sample({}, 0), b = imu.sample({}, 1);
    squares += (a.acceleration - b.acceleration).squaredNorm() / 2;
    bias_squares += a.angular_velocity.squaredNorm();
    EXPECT_EQ(a.angular_velocity, b.angular_velocity);
  }
  EXPECT_NEAR(std::sqrt(squares / (3 * kUnits)), 0.1, 0.01);
  EXPECT_NEAR(std::sqrt(bias_squares / (3 * kUnits)), 0.01, 0.001);
}

TEST(Barometer, ReadsTheHeightWithItsNoiseAndDriftsSlowly) {
  Barometer barometer({.noise_m = 0.1, .drift_m = 0.5, .drift_time_s = 100}, core::Rng(4));
  double early = 0, late = 0, step_squares = 0, before = barometer.read(20, 0.02);
  for (int i = 0; i < 500; ++i) {
    const double now = barometer.read(20, 0.02);
    step_squares += (now - before) * (now - before) / 2;
    before = now;
    early += now / 500;
  }
  for (int i = 0; i < 50000; ++i) (void)barometer.read(20, 0.02);
  for (int i = 0; i < 500; ++i) late += barometer.read(20, 0.02) / 500;
  EXPECT_NEAR(std::sqrt(step_squares / 500), 0.1, 0.02);
  EXPECT_NEAR(early, 20, 2);
  EXPECT_GT(std::abs(late - early), 0.05);
}

TEST(Battery, WhatFliesOnHalfTheChargeFliesHalfAsLong) {
  const auto endurance = [](double charge) {
    Battery battery({.charge = charge});
    int seconds = 0;
    for (; !battery.empty(); ++seconds) battery.drain(1, MotorThrusts::Constant(8));
    return seconds;
  };
  EXPECT_NEAR(endurance(0.5), 0.5 * endurance(1), 2);
}

TEST(InertialUnit, TheMeanOfManyReadingsIsTruthAndBias) {
  ImuConfig config = kExact;
  config.acceleration_noise = 0.2;
  config.rotation_noise = 0.05;
  InertialUnit imu(config, Eigen::Vector3d::Zero(), Eigen::Matrix3d::Identity(), core::Rng(6));
  Eigen::Vector3d force = Eigen::Vector3d::Zero(), rate = Eigen::Vector3d::Zero();
  constexpr int kCount = 20000;
  for (int i = 0; i < kCount; ++i) {
    const lidar::ImuSample sample = imu.sample({}, i);
    force += sample.acceleration / kCount;
    rate += sample.angular_velocity / kCount;
  }
  EXPECT_LT((force - Eigen::Vector3d(0, 0, kStandardGravity)).norm(), 0.01);
  EXPECT_LT(rate.norm(), 0.002);
}

TEST(InertialUnit, TiltedItReadsGAlongItsOwnAxes) {
  InertialUnit imu(kExact, Eigen::Vector3d::Zero(), Eigen::Matrix3d::Identity(), core::Rng(1));
  RigidState state;
  state.pose.linear() = core::so3_exp({0.3, -0.2, 1});
  const Eigen::Vector3d expected =
      state.pose.linear().transpose() * Eigen::Vector3d(0, 0, kStandardGravity);
  EXPECT_LT((imu.sample(state, 0).acceleration - expected).norm(), 1e-12);
}

TEST(InertialUnit, TheSameSeedReadsTheSame) {
  InertialUnit a({}, Eigen::Vector3d::Zero(), Eigen::Matrix3d::Identity(), core::Rng(7));
  InertialUnit b({}, Eigen::Vector3d::Zero(), Eigen::Matrix3d::Identity(), core::Rng(7));
  for (int i = 0; i < 50; ++i)
    EXPECT_EQ(a.sample({}, i).acceleration, b.sample({}, i).acceleration);
}

TEST(Barometer, WithoutNoiseAndDriftItReadsTheHeight) {
  Barometer barometer({.noise_m = 0, .drift_m = 0}, core::Rng(1));
  for (const double height : {-3.0, 0.0, 120.5}) EXPECT_EQ(barometer.read(height, 0.02), height);
}

/// The drift is stationary: of many units after any time it has the same spread.
TEST(Barometer, ItsDriftHasTheConfiguredSpreadFromTheFirstReadingOn) {
  for (const int readings : {1, 400}) {
    double squares = 0;
    constexpr int kUnits = 2000;
    for (int unit = 0; unit < kUnits; ++unit) {
      Barometer barometer({.noise_m = 0, .drift_m = 0.5, .drift_time_s = 100},
                          core::Rng(static_cast<std::uint64_t>(unit)));
      double last = 0;
      for (int i = 0; i < readings; ++i) last = barometer.read(0, 1);
      squares += last * last / kUnits;
    }
    EXPECT_NEAR(std::sqrt(squares), 0.5, 0.03) << readings;
  }
}

TEST(Battery, DrainsByThePowerOfElectronicsAndRotors) {
  const BatteryConfig config;
  Battery battery(config);
  battery.drain(60, MotorThrusts::Constant(8));
  const double power = config.electronics_w + config.watts_per_n15 * 4 * std::pow(8, 1.5);
  EXPECT_NEAR(battery.share(), 1 - 60 * power / (3600 * config.capacity_wh), 1e-12);
}

TEST(Battery, StandingStillOnlyTheElectronicsDrainIt) {
  Battery battery({.capacity_wh = 45, .electronics_w = 45});
  battery.drain(1800, MotorThrusts::Zero());
  EXPECT_NEAR(battery.share(), 0.5, 1e-12);
}

TEST(Battery, NeverHoldsLessThanNothing) {
  Battery battery({});
  battery.drain(1e6, MotorThrusts::Constant(10));
  EXPECT_EQ(battery.share(), 0);
  EXPECT_TRUE(battery.empty());
}

TEST(Battery, UnevenThrustCostsMoreThanEven) {
  Battery even({}), uneven({});
  even.drain(60, MotorThrusts::Constant(8));
  uneven.drain(60, {4, 12, 4, 12});
  EXPECT_LT(uneven.share(), even.share());
}

}  // namespace
}  // namespace saker::simulation
