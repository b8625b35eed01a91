#include "saker/lidar/imu_packet.h"

#include <numbers>

#include "saker/lidar/bytes.h"

namespace saker::lidar {
namespace {

constexpr double kStandardGravity = 9.80665;  // what the sensor calls 1 g
constexpr double kDegree = std::numbers::pi / 180;

constexpr std::size_t kSystemTimeAt = 0;
constexpr std::size_t kAccelerometerTimeAt = 8;
constexpr std::size_t kGyroscopeTimeAt = 16;
constexpr std::size_t kAccelerationAt = 24;
constexpr std::size_t kRateAt = 36;

Eigen::Vector3d read_vector(const std::uint8_t* bytes) {
  return {read_little<float>(bytes), read_little<float>(bytes + 4), read_little<float>(bytes + 8)};
}

void write_vector(const Eigen::Vector3d& v, std::uint8_t* bytes) {
  for (int i = 0; i < 3; ++i) write_little(static_cast<float>(v[i]), bytes + 4 * i);
}

}  // namespace

std::optional<ImuSample> decode_imu(std::span<const std::uint8_t> packet, const SensorInfo& info) {
  if (packet.size() != kImuPacketBytes) return std::nullopt;
  const Eigen::Matrix3d R_sensor_imu = info.T_sensor_imu.linear();
  ImuSample sample;
  sample.stamp = read_little<std::int64_t>(&packet[kGyroscopeTimeAt]);
  sample.acceleration = R_sensor_imu * read_vector(&packet[kAccelerationAt]) * kStandardGravity;
  sample.angular_velocity = R_sensor_imu * read_vector(&packet[kRateAt]) * kDegree;
  if (!sample.acceleration.allFinite() || !sample.angular_velocity.allFinite()) return std::nullopt;
  return sample;
}

std::vector<std::uint8_t> encode_imu(const ImuSample& sample, const SensorInfo& info) {
  const Eigen::Matrix3d R_imu_sensor = info.T_sensor_imu.linear().transpose();
  std::vector<std::uint8_t> packet(kImuPacketBytes, 0);
  for (const std::size_t at : {kSystemTimeAt, kAccelerometerTimeAt, kGyroscopeTimeAt}) {
    write_little(sample.stamp, &packet[at]);
  }
  write_vector(R_imu_sensor * sample.acceleration / kStandardGravity, &packet[kAccelerationAt]);
  write_vector(R_imu_sensor * sample.angular_velocity / kDegree, &packet[kRateAt]);
  return packet;
}

}  // namespace saker::lidar
