#include "odometry/odometry.h"

#include <gtest/gtest.h>

#include <cstring>

#include "core/error.h"
#include "made_world.h"

namespace saker::odometry {
namespace {

using testing::MadeSensor;
using testing::MadeWorld;
using testing::Motion;

constexpr Time kPeriod = 100'000'000;

struct Flight {
  std::vector<OdometryEstimate> estimates;
  double worst_position_m = 0;
  double worst_rotation_rad = 0;
  int not_ok = 0;
};

/// Flies `count` scans, compared with the motion relative to the first scan (levelled where an IMU
/// is used).
Flight fly(const MadeWorld& world, const MadeSensor& sensor, const Motion& motion, int count,
           bool with_imu, const Eigen::Vector3d& gyro_bias = Eigen::Vector3d::Zero()) {
  Odometry odometry{OdometryConfig{}};
  Flight flight;
  SE3 T_odom_world = motion(kPeriod).inverse();
  for (int k = 1; k <= count; ++k) {
    const Time stamp = k * kPeriod;
    std::vector<lidar::ImuSample> imu;
    if (with_imu) imu = testing::imu(motion, stamp - kPeriod, stamp, gyro_bias);
    flight.estimates.push_back(odometry.register_scan(scan(world, sensor, motion, stamp), imu));
    const OdometryEstimate& estimate = flight.estimates.back();
    if (k == 1) T_odom_world = estimate.T_odom_lidar * T_odom_world;
    const SE3 error = (T_odom_world * motion(stamp)).inverse() * estimate.T_odom_lidar;
    flight.worst_position_m = std::max(flight.worst_position_m, error.translation().norm());
    flight.worst_rotation_rad =
        std::max(flight.worst_rotation_rad, core::so3_log(error.linear()).norm());
    flight.not_ok += estimate.status != OdometryStatus::ok;
  }
  return flight;
}

TEST(Odometry, StraightAtConstantSpeedIsExactToMillimetres) {
  const Flight flight = fly(testing::street(), {}, testing::straight(5), 60, false);
  EXPECT_EQ(flight.not_ok, 0);
  EXPECT_LT(flight.worst_position_m, 0.02);
  EXPECT_LT(flight.worst_rotation_rad, 0.001);
}

TEST(Odometry, WeavingFlightWithoutImuStaysWithinCentimetres) {
  MadeSensor sensor;
  sensor.range_noise_m = 0.02;
  const Flight flight = fly(testing::street(), sensor, testing::weaving, 200, false);
  EXPECT_EQ(flight.not_ok, 0);
  EXPECT_LT(flight.worst_position_m, 0.15);
  EXPECT_LT(flight.worst_rotation_rad, 0.01);
}

TEST(Odometry, WeavingFlightWithImuAndGyroBiasStaysWithinCentimetres) {
  MadeSensor sensor;
  sensor.range_noise_m = 0.02;
  const Flight flight =
      fly(testing::street(), sensor, testing::weaving, 200, true, {0.01, -0.02, 0.015});
  EXPECT_EQ(flight.not_ok, 0);
  EXPECT_TRUE(flight.estimates.back().diagnostics.gyro_used);
  EXPECT_LT(flight.worst_position_m, 0.1);
  EXPECT_LT(flight.worst_rotation_rad, 0.005);
}

}  // namespace
}  // namespace saker::odometry
