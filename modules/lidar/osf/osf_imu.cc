#include "saker/lidar/osf/osf_imu.h"

#include <bit>
#include <cmath>
#include <optional>

#include "saker/lidar/bytes.h"
#include "saker/lidar/osf/osf_image.h"

namespace saker::lidar {
namespace {

constexpr double kStandardGravity = 9.80665;
constexpr double kDegree = M_PI / 180;
constexpr std::size_t kMostSamples = 4096;  // in a scan; a sensor sends 64

// Fields of the tables, in their order in the vendor's schemas.
enum Scan { kCustomFields = 8 };
enum Field { kName = 0, kData = 4 };

std::optional<ByteView> data_of(const std::vector<FlatTable>& fields, std::string_view name) {
  for (const FlatTable& field : fields) {
    if (text_of(field.bytes(kName)) == name) return field.bytes(kData);
  }
  return std::nullopt;
}

/// Three float32 of each of `count` rows; empty where they are not that many.
std::vector<Eigen::Vector3d> vectors_of(ByteView packed, std::size_t count) {
  OsfImage image;
  if (!unpack_osf_image(packed, count, 3, image) || image.bytes_a_pixel != sizeof(float)) return {};
  std::vector<Eigen::Vector3d> vectors(count);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto bits = static_cast<std::uint32_t>(image.pixel(i, k));
      vectors[i][static_cast<Eigen::Index>(k)] = std::bit_cast<float>(bits);
    }
  }
  return vectors;
}

}  // namespace

std::vector<ImuSample> osf_imu_samples(const FlatTable& scan, const SensorInfo& info) {
  const std::vector<FlatTable> fields = scan.tables(kCustomFields);
  const auto times = data_of(fields, "IMU_TIMESTAMP"), valid = data_of(fields, "IMU_STATUS");
  const auto accelerations = data_of(fields, "IMU_ACC"), rates = data_of(fields, "IMU_GYRO");
  if (!times || !accelerations || !rates) return {};
  const std::size_t count = times->size() / sizeof(std::int64_t);
  if (count == 0 || count > kMostSamples) return {};
  const auto acceleration = vectors_of(*accelerations, count), rate = vectors_of(*rates, count);
  if (acceleration.empty() || rate.empty()) return {};
  const Eigen::Matrix3d R_sensor_imu = info.T_sensor_imu.linear();
  std::vector<ImuSample> samples;
  for (std::size_t i = 0; i < count; ++i) {
    if (valid && valid->size() >= 2 * count && ((*valid)[2 * i] & 1) == 0) continue;
    const ImuSample sample{read_little<std::int64_t>(&(*times)[8 * i]),
                           R_sensor_imu * acceleration[i] * kStandardGravity,
                           R_sensor_imu * rate[i] * kDegree};
    if (!sample.acceleration.allFinite() || !sample.angular_velocity.allFinite()) continue;
    samples.push_back(sample);
  }
  return samples;
}

}  // namespace saker::lidar
