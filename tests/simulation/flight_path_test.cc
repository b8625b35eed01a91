#include "saker/simulation/mission/flight_path.h"

#include <gtest/gtest.h>

#include "saker/simulation/mission/flight.h"

namespace saker::simulation {
namespace {

struct Flown {
  FlightConfig config;
  BuiltWorld built;
};

Flown fly(std::uint64_t seed) {
  const FlightConfig config;
  return {config, build_flight_world(config, seed).built};
}

ImuConfig ideal() {
  ImuConfig config;
  config.acceleration_noise = config.rotation_noise = 0;
  config.acceleration_bias = config.rotation_bias = 0;
  return config;
}

TEST(FlightPath, BeginsAndEndsHovering) {
  const Flown f = fly(2);
  core::Rng rng(2);
  const FlightPath path(f.config, f.built.terrain, rng);
  EXPECT_LT((path.pose(1.4).translation() - path.pose(0).translation()).norm(), 1e-6);
  const double length = (path.pose(40).translation() - path.pose(0).translation()).norm();
  EXPECT_NEAR(length, 2.0 * (40 - 2 * 1.5 - 2.5), 5);
}

TEST(FlightPath, TiltStaysThatOfAMultirotor) {
  const Flown f = fly(2);
  core::Rng rng(2);
  const FlightPath path(f.config, f.built.terrain, rng);
  for (double t = 0; t < 40; t += 0.05) {
    EXPECT_GT(path.pose(t).linear()(2, 2), std::cos(20 * M_PI / 180)) << t;
  }
}

TEST(FlightPath, StandingStillTheUnitReadsOneG) {
  const Flown f = fly(3);
  core::Rng path_rng(3), rng(1);
  FlightConfig config = f.config;
  config.vibration_deg = 0;
  const FlightPath path(config, f.built.terrain, path_rng);
  const auto samples =
      simulate_imu([&](double t) { return path.pose(t); }, ideal(), SE3::Identity(), 1.2, 0, rng);
  for (const lidar::ImuSample& sample : samples) {
    EXPECT_NEAR((sample.acceleration - Eigen::Vector3d(0, 0, 9.80665)).norm(), 0, 1e-3);
    EXPECT_NEAR(sample.angular_velocity.norm(), 0, 1e-6);
  }
}

/// Integrates the readings: the unit has to arrive where the path does.
TEST(FlightPath, ReadingsIntegrateToThePath) {
  const Flown f = fly(4);
  core::Rng path_rng(4), rng(1);
  FlightConfig config = f.config;
  config.vibration_deg = 0;
  const FlightPath path(config, f.built.terrain, path_rng);
  ImuConfig imu = ideal();
  imu.rate_hz = 1000;
  SE3 T_lidar_imu = placed(0.01, -0.02, 0.03);
  const auto samples =
      simulate_imu([&](double t) { return path.pose(t); }, imu, T_lidar_imu, 10, 0, rng);
  SE3 T = path.pose(0) * T_lidar_imu;
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  for (const lidar::ImuSample& sample : samples) {
    const double dt = 1e-3;
    const Eigen::Vector3d a = T.linear() * sample.acceleration - 9.80665 * Eigen::Vector3d::UnitZ();
    T.translation() += velocity * dt + 0.5 * a * dt * dt;
    velocity += a * dt;
    T.linear() = T.linear() * core::so3_exp(sample.angular_velocity * dt);
  }
  const SE3 expected = path.pose(10) * T_lidar_imu;
  EXPECT_LT((T.translation() - expected.translation()).norm(), 0.05);
  EXPECT_LT(core::so3_log(T.linear().transpose() * expected.linear()).norm(), 2e-3);
}

}  // namespace
}  // namespace saker::simulation
