#pragma once

#include <vector>

#include "saker/core/rng.h"
#include "saker/core/se3.h"
#include "saker/lidar/sensor_info.h"

namespace saker::simulation {

/// Where the beams of a turning LiDAR start and point, in its lidar frame, by row (the highest
/// first) and column (in the order of time).
struct BeamTable {
  int rows = 0;
  int columns = 0;
  std::vector<Eigen::Vector3f> origins;     ///< of range 0; row-major, rows × columns
  std::vector<Eigen::Vector3f> directions;  ///< unit

  [[nodiscard]] std::size_t index(int row, int column) const {
    return static_cast<std::size_t>(row) * columns + column;
  }
};

/// The beams of an Ouster sensor as its metadata says: columns turn clockwise from above.
[[nodiscard]] BeamTable ouster_beams(const lidar::SensorInfo& info);

/// A Velodyne HDL-64E: 32 beams every 1/3° from +2° down, 32 every 1/2° from −8.83°, about 2,080
/// columns. `rng` gives this unit its calibration errors and speed: real ones are off by tenths of
/// a degree.
[[nodiscard]] BeamTable hdl64_beams(core::Rng& rng);

}  // namespace saker::simulation
