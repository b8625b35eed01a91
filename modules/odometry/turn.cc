#include "saker/odometry/turn.h"

#include <algorithm>
#include <cmath>

namespace saker::odometry {

double Turn::passed(double azimuth_rad) const {
  const double turns = (azimuth_rad - begin_rad) / (2 * M_PI) * (clockwise ? -1 : 1);
  return turns - std::floor(turns);
}

float azimuth_of(const Eigen::Vector3f& p_sensor) {
  return p_sensor.allFinite() ? std::atan2(p_sensor.y(), p_sensor.x()) : 0.0F;
}

lidar::Scan timed(const lidar::Scan& scan, const Turn& turn, Time period) {
  lidar::Scan result = scan;
  result.stamp += period - period / 2;
  result.offset_ns.resize(scan.size());
  const Eigen::Isometry3f T_sensor_lidar = scan.T_lidar_sensor.inverse();
  const auto offset_ns = [&](const Eigen::Vector3f& point) {
    const double left = 1 - turn.passed(static_cast<double>(azimuth_of(T_sensor_lidar * point)));
    return static_cast<std::int32_t>(-left * static_cast<double>(period));
  };
  std::transform(scan.points.begin(), scan.points.end(), result.offset_ns.begin(), offset_ns);
  return result;
}

}  // namespace saker::odometry
