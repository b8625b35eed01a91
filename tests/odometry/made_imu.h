#pragma once

#include <vector>

#include "saker/lidar/scan.h"

/// Readings of an inertial unit whose motion is simple.
namespace saker::odometry::testing {

inline const Eigen::Vector3d kUp(0, 0, 9.80665);  ///< m/s², what a unit at rest and level reads

[[nodiscard]] inline lidar::ImuSample reading(double seconds, const Eigen::Vector3d& acceleration,
                                              const Eigen::Vector3d& rate) {
  return {from_seconds(seconds), acceleration, rate};
}

/// The same reading at 100 Hz over (begin, end].
[[nodiscard]] inline std::vector<lidar::ImuSample> steady(
    double begin, double end, const Eigen::Vector3d& acceleration = kUp,
    const Eigen::Vector3d& rate = Eigen::Vector3d::Zero()) {
  std::vector<lidar::ImuSample> samples;
  for (int i = 1; begin + 0.01 * i < end + 1e-6; ++i) {
    samples.push_back(reading(begin + 0.01 * i, acceleration, rate));
  }
  return samples;
}

}  // namespace saker::odometry::testing
