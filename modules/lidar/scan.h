#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <vector>

#include "saker/core/se3.h"
#include "saker/core/time.h"

namespace saker::lidar {

/// One revolution of a sensor, in the lidar frame (Ouster's sensor frame, KITTI's velodyne frame),
/// metres.
///
/// Organised (rows > 0): rows × columns points, row-major, row 0 the highest beam, columns in the
/// order of time, destaggered so that neighbours in a row are neighbours in azimuth; a pixel
/// without a return is a point of NaN. Unorganised (rows = 0): the points as they came, in the
/// input's order. A scan from a file may hold any float, NaN included: every reader of `points`
/// skips what is not finite.
struct Scan {
  Time stamp = 0;  ///< time of the last column
  int rows = 0;
  int columns = 0;
  std::vector<Eigen::Vector3f> points;
  std::vector<float> reflectivity;      ///< 0 … 1, one a point
  std::vector<std::int32_t> offset_ns;  ///< ≤ 0, time of the point relative to `stamp`, one a point
  std::vector<std::uint16_t> ring;      ///< beam of each point as the recording says; or empty
  /// Where the beams start: the identity, but for recordings that are published in another frame
  /// than the sensor's (sensor_origin.h).
  Eigen::Isometry3f T_lidar_sensor = Eigen::Isometry3f::Identity();

  [[nodiscard]] bool organised() const { return rows > 0; }
  [[nodiscard]] std::size_t size() const { return points.size(); }
  [[nodiscard]] Time time_of(std::size_t i) const { return stamp + offset_ns[i]; }
};

/// One reading of the sensor's inertial unit, in the lidar frame (turned from the unit's own axes
/// by the reader).
struct ImuSample {
  Time stamp = 0;
  Eigen::Vector3d acceleration = Eigen::Vector3d::Constant(NAN);      ///< m/s², specific force
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Constant(NAN);  ///< rad/s
};

/// What a scan's points are: one entry a point of `Scan::points`, in their order. A point that was
/// not classified has class `other` (0) and probability 0.
struct Labels {
  std::vector<std::uint8_t> classes;  ///< index into objects::ClassTable
  std::vector<float> probability;     ///< of that class, 0 … 1
};

}  // namespace saker::lidar
