#include "saker/simulation/vehicle/instruments.h"

#include <gtest/gtest.h>

namespace saker::simulation {
namespace {

const ImuConfig kExact{.rate_hz = 100,
                       .acceleration_noise = 0,
                       .rotation_noise = 0,
                       .acceleration_bias = 0,
                       .rotation_bias = 0};

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

}  // namespace
}  // namespace saker::simulation
