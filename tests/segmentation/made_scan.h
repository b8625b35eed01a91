#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "lidar/scan.h"

namespace saker::segmentation::testing {

/// A sensor in a made place: flat ground, and a wall where one is given. Rows from +15° to −25°.
struct MadeScan {
  int rows = 64;
  int columns = 1024;
  float height_m = 2;  ///< of the sensor over the ground
  float wall_m = 20;   ///< distance of a round wall about the sensor, 4 m high
  Eigen::Quaternionf tilt = Eigen::Quaternionf::Identity();  ///< of the sensor

  /// Organised, in the sensor's frame; NaN where nothing is hit.
  [[nodiscard]] lidar::Scan organised() const;
};

/// The finite points of an organised scan ring by ring, from azimuth 0 leftwards, as KITTI has
/// them.
struct RingFile {
  lidar::Scan scan;
  std::vector<int> row;  ///< true row of each point
};
[[nodiscard]] RingFile ring_by_ring(const lidar::Scan& organised);

}  // namespace saker::segmentation::testing
