#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "saker/lidar/scan.h"

/// Where the beams of a recording start, for recordings that are published in another frame than
/// the sensor's (a car's, for instance).
///
/// Reads unorganised scans; makes T_lidar_sensor (x, y, z, roll and pitch; yaw stays 0, because
/// beams do not tell it). Method: about the sensor's origin each beam draws a cone, so that the
/// histogram of elevations has sharp peaks; about any other point they are smeared
/// (beam_sharpness.h). The sharpness is searched on a grid of origins (±2, ±1, −2.5 … 3 m), in
/// sectors of azimuth that a tilt shifts as a whole, then over all five unknowns (tilts of ±3°).
/// Where the recording has ring numbers, each ring is fitted a cone instead (ring_cones.h).
/// Cost: 0.25 s a scan, a second one 0.1 s; 0.05 s with ring numbers.
///
/// A scan that was compensated for the vehicle's motion has no single origin: its beams start along
/// the path of one revolution. The middle of that is found, up to half a metre from the sensor's
/// own place. Height and tilt do not suffer.
namespace saker::lidar {

/// \param points  in the recording's frame, m
/// \param rings   ring number of each point, or empty
/// \return nothing where the frame is the sensor's (within 0.3 m upwards, 0.6 m along the ground),
///         where beams are not much sharper anywhere else, and where one origin does not explain
///         the scan (two sensors, a round place)
[[nodiscard]] std::optional<Eigen::Isometry3f> find_sensor_origin(
    const std::vector<Eigen::Vector3f>& points, const std::vector<std::uint16_t>& rings = {});

/// The origin of the sharpest scan, where at least two scans tell one (the only one, if there is
/// one), at most one tells nothing, and all agree within 0.1 m upwards and 0.7 m along the ground.
[[nodiscard]] std::optional<Eigen::Isometry3f> find_sensor_origin(std::span<const Scan> scans);

/// The same of a recording of `count` scans, by its first, middle and last one that can be read.
/// \param read  fills a scan; what it returns is a fault, or empty
[[nodiscard]] std::optional<Eigen::Isometry3f> find_sensor_origin(
    std::size_t count, const std::function<std::string(std::size_t, Scan&)>& read);

/// "the recording's frame is not the sensor's: beams start at x 0.80 y 0.00 z 1.86 m, pitched by
/// 0.9°, rolled by 0.0°".
[[nodiscard]] std::string describe_sensor_origin(const Eigen::Isometry3f& T_lidar_sensor);

}  // namespace saker::lidar
