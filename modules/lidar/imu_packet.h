#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "saker/lidar/scan.h"
#include "saker/lidar/sensor_info.h"

/// The inertial unit's packets (48 bytes), both ways. They carry accelerations in g and rates in
/// degrees per second in the unit's own axes; an ImuSample is in SI units and in the sensor frame,
/// at the time of the gyroscope's reading.
namespace saker::lidar {

inline constexpr std::size_t kImuPacketBytes = 48;

/// Nothing when the size is wrong or a reading is not finite.
[[nodiscard]] std::optional<ImuSample> decode_imu(std::span<const std::uint8_t> packet,
                                                  const SensorInfo& info);

[[nodiscard]] std::vector<std::uint8_t> encode_imu(const ImuSample& sample, const SensorInfo& info);

}  // namespace saker::lidar
