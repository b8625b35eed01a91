#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "saker/lidar/scan.h"

namespace saker::lidar::testing {

/// A sensor in a made place: flat ground, and a wall where one is given. Rows from +15° to −25°,
/// evenly spaced unless `elevation_deg` says otherwise.
struct MadeScan {
  int rows = 64;
  int columns = 1024;
  float height_m = 2;                     ///< of the sensor over the ground
  float wall_m = 20;                      ///< distance of a round wall about the sensor, 4 m high
  std::vector<float> elevation_deg = {};  ///< of each row, the highest first; or empty
  Eigen::Quaternionf tilt = Eigen::Quaternionf::Identity();  ///< of the sensor

  /// Organised, in the sensor's frame; NaN where nothing is hit.
  [[nodiscard]] Scan organised() const;
};

/// Two things of different width half way to the wall, and nothing on their other hand.
[[nodiscard]] Scan with_handedness(Scan organised);

/// As a mirror in the x-z plane shows it.
[[nodiscard]] Scan mirrored(const Scan& organised);

/// 64 beams as a Pandar64 has them: every sixth of a degree about the horizon, up to 6° elsewhere.
[[nodiscard]] std::vector<float> uneven_elevations();

/// The finite points of an organised scan ring by ring, from azimuth 0 leftwards, as KITTI has
/// them.
struct RingFile {
  Scan scan;
  std::vector<int> row;  ///< true row of each point
};
[[nodiscard]] RingFile ring_by_ring(const Scan& organised);

/// The same in an order that says nothing.
[[nodiscard]] RingFile shuffled(RingFile file, std::uint64_t seed);

/// A sensor 1.86 m over the ground among blocks at random distances on rough ground, its points in
/// another frame. (About a sensor in a round place every point of its axis would see sharp rings.)
[[nodiscard]] Scan scan_in(const Eigen::Isometry3f& T_frame_sensor, std::uint64_t place = 1);

}  // namespace saker::lidar::testing
