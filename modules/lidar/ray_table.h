#pragma once

#include <Eigen/Core>
#include <vector>

#include "saker/lidar/sensor_info.h"

namespace saker::lidar {

/// Where the beam of each pixel starts and points, in the sensor frame: the vendor's formula
/// ("Software User Manual", sensor coordinate frame), tabulated once.
///
///     θ_e = 2π (1 − column / columns),  θ_a = −azimuth,  φ = altitude,  n = |beam origin|
///     p_L = (r − n) [cos(θ_e + θ_a) cos φ, sin(θ_e + θ_a) cos φ, sin φ] + [b_x cos θ_e, b_x sin
///     θ_e, b_z] p_S = T_S_L p_L
class RayTable {
 public:
  struct Ray {
    Eigen::Vector3f direction;  ///< of length 1
    Eigen::Vector3f origin;     ///< the point of range 0, metres
  };

  explicit RayTable(const SensorInfo& info);

  /// Row-major, columns as sent (staggered).
  [[nodiscard]] const Ray& ray(int row, int column) const {
    return rays_[static_cast<std::size_t>(row) * columns_ + column];
  }

 private:
  std::size_t columns_;
  std::vector<Ray> rays_;
};

}  // namespace saker::lidar
