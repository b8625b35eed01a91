#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "saker/lidar/scan.h"
#include "saker/lidar/sensor_info.h"

/// The inertial unit's packets, both ways. An ImuSample is in SI units and in the sensor frame.
///
/// Packets of 48 bytes (profile LEGACY) carry one sample: accelerations in g and rates in degrees
/// per second in the unit's own axes; the sample's time is that of the gyroscope's reading. Those
/// of ACCEL32_GYRO32_NMEA (firmware 3.2; 452 bytes with eight samples) carry m/s² and rad/s, or, as
/// the mean length of a packet's accelerations tells (1 or 9.8), g and degrees per second, between
/// a head and a foot as lidar packets have them, after 100 bytes for the receiver of a satellite
/// navigation system. Layouts after the vendor's "Software User Manual".
namespace saker::lidar {

inline constexpr std::size_t kImuPacketBytes = 48;

/// Whether it holds inertial samples, of either kind, by its size and its head.
[[nodiscard]] bool is_imu_packet(std::span<const std::uint8_t> packet);

/// Oldest first; nothing when the size is wrong. Samples whose readings are not finite, or that the
/// sensor calls not valid, are left out.
[[nodiscard]] std::vector<ImuSample> decode_imu(std::span<const std::uint8_t> packet,
                                                const SensorInfo& info);

/// A packet of the profile LEGACY.
[[nodiscard]] std::vector<std::uint8_t> encode_imu(const ImuSample& sample, const SensorInfo& info);

/// A packet of ACCEL32_GYRO32_NMEA.
[[nodiscard]] std::vector<std::uint8_t> encode_imu(std::span<const ImuSample> samples,
                                                   const SensorInfo& info);

}  // namespace saker::lidar
