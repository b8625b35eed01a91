#pragma once

#include "saker/core/time.h"
#include "saker/lidar/scan.h"

namespace saker::odometry {

/// How a sensor turns: what a recording without times of points leaves out.
struct Turn {
  bool clockwise = true;  ///< seen from above
  double begin_rad = 0;   ///< azimuth at which a sweep begins, in the sensor's frame

  /// The part of a sweep, 0 to 1, that is over when the sensor looks along this azimuth.
  [[nodiscard]] double passed(double azimuth_rad) const;
};

/// Of a point in the sensor's frame, −π … π; 0 of one that is not finite.
[[nodiscard]] float azimuth_of(const Eigen::Vector3f& p_sensor);

/// The scan with times: `stamp` of the scan that comes in counts as the middle of its sweep, that
/// of the one that comes out is its end, half a period later.
[[nodiscard]] lidar::Scan timed(const lidar::Scan& scan, const Turn& turn, Time period);

}  // namespace saker::odometry
