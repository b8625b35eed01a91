#pragma once

#include "made_sensor.h"

/// OSF files, written apart from the reader by the vendor's schemas.
namespace saker::lidar::testing {

/// 16 rows, 512 columns, of a known serial number.
[[nodiscard]] SensorInfo osf_sensor();

/// Frames of made_sensor.h, one a chunk. \param png  as older files have their images
/// \param timed  false: scans without a time of a column
/// \param imu    samples in each scan, as made_osf_sample has them; every fifth is not valid
[[nodiscard]] Bytes made_osf(const SensorInfo& info, int frames, bool png, bool timed = true,
                             int imu = 0);

/// In the inertial unit's axes, g and degrees a second.
struct MadeOsfSample {
  Time stamp;
  Eigen::Vector3f acceleration, rate;
};
[[nodiscard]] MadeOsfSample made_osf_sample(const SensorInfo& info, int frame, int i);

/// Today's packing of 32-bit numbers, by its description: planes of blue, green less blue, green
/// less red and the fourth byte, each less its left neighbour.
[[nodiscard]] Bytes packed32(const std::vector<std::uint32_t>& values, std::size_t rows,
                             std::size_t columns);

/// PNG, its colours the number's bytes; rows destaggered.
[[nodiscard]] Bytes png32(const std::vector<std::uint32_t>& values, const SensorInfo& info);

}  // namespace saker::lidar::testing
