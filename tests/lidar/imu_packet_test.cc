#include "saker/lidar/imu_packet.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

namespace saker::lidar {
namespace {

ImuSample sample() {
  ImuSample made;
  made.stamp = 1'462'582'413'750;
  made.acceleration = {0.4, -0.2, 9.7};
  made.angular_velocity = {0.01, -0.3, 1.2};
  return made;
}

SensorInfo turned_imu() {
  SensorInfo info = SensorInfo::make_os1(64, 1024, PacketProfile::kLegacy);
  info.T_sensor_imu.linear() =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  return info;
}

TEST(ImuPacket, SurvivesEncodingAndDecodingToFloatPrecision) {
  const SensorInfo info = turned_imu();
  const auto decoded = decode_imu(encode_imu(sample(), info), info);
  ASSERT_TRUE(decoded);
  EXPECT_EQ(decoded->stamp, sample().stamp);
  EXPECT_LT((decoded->acceleration - sample().acceleration).norm(), 1e-5);
  EXPECT_LT((decoded->angular_velocity - sample().angular_velocity).norm(), 1e-6);
}

TEST(ImuPacket, CarriesGAndDegreesInTheUnitsAxes) {
  SensorInfo info = SensorInfo::make_os1(64, 1024, PacketProfile::kLegacy);
  info.T_sensor_imu.linear() =
      Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  ImuSample made = sample();
  made.acceleration = {0, 9.80665, 0};  // along the unit's x
  made.angular_velocity = {0, 0, M_PI};
  const auto packet = encode_imu(made, info);
  float acceleration = 0;
  float rate = 0;
  std::memcpy(&acceleration, &packet[24], 4);
  std::memcpy(&rate, &packet[44], 4);
  EXPECT_NEAR(acceleration, 1, 1e-6);
  EXPECT_NEAR(rate, 180, 1e-4);
}

TEST(ImuPacket, OtherSizesAndNumbersThatAreNotFiniteAreRefused) {
  const SensorInfo info = turned_imu();
  auto packet = encode_imu(sample(), info);
  packet.pop_back();
  EXPECT_FALSE(decode_imu(packet, info));
  ImuSample made = sample();
  made.angular_velocity.x() = NAN;
  EXPECT_FALSE(decode_imu(encode_imu(made, info), info));
  EXPECT_FALSE(decode_imu({}, info));
}

}  // namespace
}  // namespace saker::lidar
