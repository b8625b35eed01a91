#include "saker/lidar/imu_packet.h"

#include <numbers>

#include "saker/lidar/bytes.h"
#include "saker/lidar/packet.h"

namespace saker::lidar {
namespace {

constexpr double kStandardGravity = 9.80665;  // what the sensor calls 1 g
constexpr double kDegree = std::numbers::pi / 180;

constexpr std::size_t kSystemTimeAt = 0;
constexpr std::size_t kAccelerometerTimeAt = 8;
constexpr std::size_t kGyroscopeTimeAt = 16;
constexpr std::size_t kAccelerationAt = 24;
constexpr std::size_t kRateAt = 36;

// ACCEL32_GYRO32_NMEA: head, time and sentence of the receiver, measurements, foot.
constexpr std::size_t kReceiverBytes = 100;
constexpr std::size_t kMeasurementBytes = 36;
constexpr std::size_t kMostMeasurements = 64;
constexpr std::size_t kMeasurementsAt = kPacketHeadBytes + kReceiverBytes;
constexpr std::size_t kMeasurementStatusAt = 10;
constexpr std::size_t kMeasurementAccelerationAt = 12;
constexpr std::size_t kMeasurementRateAt = 24;
constexpr std::uint8_t kImuPacketType = 2;

/// 0 where it is a packet of another kind.
std::size_t measurements_in(std::span<const std::uint8_t> packet) {
  constexpr std::size_t kRest = kMeasurementsAt + kPacketHeadBytes;
  const std::size_t bytes = packet.size();
  if (bytes <= kRest || (bytes - kRest) % kMeasurementBytes != 0) return 0;
  const std::size_t count = (bytes - kRest) / kMeasurementBytes;
  return packet[0] == kImuPacketType && count <= kMostMeasurements ? count : 0;
}

Eigen::Vector3d read_vector(const std::uint8_t* bytes) {
  return {read_little<float>(bytes), read_little<float>(bytes + 4), read_little<float>(bytes + 8)};
}

void write_vector(const Eigen::Vector3d& v, std::uint8_t* bytes) {
  for (int i = 0; i < 3; ++i) write_little(static_cast<float>(v[i]), bytes + 4 * i);
}

/// By the mean length of the accelerations.
bool in_si_units(std::span<const std::uint8_t> packet) {
  constexpr double kBetween = 3.13;
  const std::size_t count = measurements_in(packet);
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = kMeasurementsAt + i * kMeasurementBytes + kMeasurementAccelerationAt;
    sum += read_vector(&packet[at]).norm();
  }
  return !(sum < kBetween * static_cast<double>(count));
}

/// From the unit's axes to the sensor's; into `samples` where it is finite.
void add_sample(ImuSample sample, const SensorInfo& info, std::vector<ImuSample>& samples) {
  const Eigen::Matrix3d R_sensor_imu = info.T_sensor_imu.linear();
  sample.acceleration = R_sensor_imu * sample.acceleration;
  sample.angular_velocity = R_sensor_imu * sample.angular_velocity;
  if (sample.acceleration.allFinite() && sample.angular_velocity.allFinite()) {
    samples.push_back(sample);
  }
}

}  // namespace

bool is_imu_packet(std::span<const std::uint8_t> packet) {
  return packet.size() == kImuPacketBytes || measurements_in(packet) > 0;
}

std::vector<ImuSample> decode_imu(std::span<const std::uint8_t> packet, const SensorInfo& info) {
  std::vector<ImuSample> samples;
  if (packet.size() == kImuPacketBytes) {
    add_sample({read_little<std::int64_t>(&packet[kGyroscopeTimeAt]),
                read_vector(&packet[kAccelerationAt]) * kStandardGravity,
                read_vector(&packet[kRateAt]) * kDegree},
               info, samples);
    return samples;
  }
  const bool si = in_si_units(packet);
  const double acceleration_unit = si ? 1 : kStandardGravity, rate_unit = si ? 1 : kDegree;
  for (std::size_t i = 0; i < measurements_in(packet); ++i) {
    const std::uint8_t* at = &packet[kMeasurementsAt + i * kMeasurementBytes];
    if ((at[kMeasurementStatusAt] & 1) == 0) continue;
    add_sample({read_little<std::int64_t>(at),
                read_vector(at + kMeasurementAccelerationAt) * acceleration_unit,
                read_vector(at + kMeasurementRateAt) * rate_unit},
               info, samples);
  }
  return samples;
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

std::vector<std::uint8_t> encode_imu(std::span<const ImuSample> samples, const SensorInfo& info) {
  const Eigen::Matrix3d R_imu_sensor = info.T_sensor_imu.linear().transpose();
  std::vector<std::uint8_t> packet(
      kMeasurementsAt + samples.size() * kMeasurementBytes + kPacketHeadBytes, 0);
  packet[0] = kImuPacketType;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    std::uint8_t* at = &packet[kMeasurementsAt + i * kMeasurementBytes];
    write_little(samples[i].stamp, at);
    at[kMeasurementStatusAt] = 1;
    write_vector(R_imu_sensor * samples[i].acceleration, at + kMeasurementAccelerationAt);
    write_vector(R_imu_sensor * samples[i].angular_velocity, at + kMeasurementRateAt);
  }
  return packet;
}

}  // namespace saker::lidar
