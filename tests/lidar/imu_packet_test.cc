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
  ASSERT_EQ(decoded.size(), 1U);
  EXPECT_EQ(decoded[0].stamp, sample().stamp);
  EXPECT_LT((decoded[0].acceleration - sample().acceleration).norm(), 1e-5);
  EXPECT_LT((decoded[0].angular_velocity - sample().angular_velocity).norm(), 1e-6);
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
  EXPECT_TRUE(decode_imu(packet, info).empty());
  ImuSample made = sample();
  made.angular_velocity.x() = NAN;
  EXPECT_TRUE(decode_imu(encode_imu(made, info), info).empty());
  EXPECT_TRUE(decode_imu({}, info).empty());
}

std::vector<ImuSample> eight_samples() {
  std::vector<ImuSample> samples;
  for (int i = 0; i < 8; ++i) {
    samples.push_back(sample());
    samples.back().stamp += i * 1'562'500;
    samples.back().angular_velocity.z() += 0.1 * i;
  }
  return samples;
}

TEST(ImuPacket, PacketsOfEightSamplesHaveTheDocumentedSizeAndSurvive) {
  const SensorInfo info = turned_imu();
  const auto samples = eight_samples();
  const auto packet = encode_imu(samples, info);
  EXPECT_EQ(packet.size(), 452U);
  EXPECT_TRUE(is_imu_packet(packet));
  const auto decoded = decode_imu(packet, info);
  ASSERT_EQ(decoded.size(), 8U);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_EQ(decoded[i].stamp, samples[i].stamp);
    EXPECT_LT((decoded[i].acceleration - samples[i].acceleration).norm(), 1e-5);
    EXPECT_LT((decoded[i].angular_velocity - samples[i].angular_velocity).norm(), 1e-6);
  }
}

TEST(ImuPacket, PacketsOfEightSamplesInGAreToldByTheLengthOfTheAcceleration) {
  const SensorInfo info = turned_imu();
  auto samples = eight_samples();
  for (ImuSample& s : samples) {
    s.acceleration /= 9.80665;
    s.angular_velocity *= 180 / M_PI;
  }
  const auto decoded = decode_imu(encode_imu(samples, info), info);
  ASSERT_EQ(decoded.size(), 8U);
  EXPECT_LT((decoded[7].acceleration - eight_samples()[7].acceleration).norm(), 1e-5);
  EXPECT_LT((decoded[7].angular_velocity - eight_samples()[7].angular_velocity).norm(), 1e-5);
}

TEST(ImuPacket, SamplesThatTheSensorCallsNotValidAreLeftOut) {
  const SensorInfo info = turned_imu();
  auto packet = encode_imu(eight_samples(), info);
  packet[32 + 100 + 36 + 10] = 0;  // the status of the second
  const auto decoded = decode_imu(packet, info);
  ASSERT_EQ(decoded.size(), 7U);
  EXPECT_EQ(decoded[1].stamp, eight_samples()[2].stamp);
}

TEST(ImuPacket, ALidarPacketOfTheSameSizeIsNone) {
  // 16 rows of RNG15_RFL8_NIR8 are 1280 bytes, as 31 samples would be.
  const SensorInfo info = SensorInfo::make_os1(16, 512, PacketProfile::kRng15Rfl8Nir8);
  std::vector<std::uint8_t> packet(1280, 0);
  packet[0] = 1;
  EXPECT_FALSE(is_imu_packet(packet));
  packet[0] = 2;
  EXPECT_TRUE(is_imu_packet(packet));
}

}  // namespace
}  // namespace saker::lidar
