#pragma once

#include <functional>
#include <vector>

#include "saker/lidar/scan.h"

namespace saker::odometry::testing {

/// An upright box, in the world.
struct Box {
  Eigen::Vector3d low, high;
};

/// Ground about z = 0 and boxes, cast exactly.
struct MadeWorld {
  std::vector<Box> boxes;
  bool ground = true;
  double roughness_m = 0;  ///< sd of the ground's height, in waves of 3 to 9 m

  /// Distance along the unit direction; infinite when nothing is hit.
  [[nodiscard]] double cast(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const;
};

/// A street along x: house fronts with bays on both sides, parked boxes, poles.
[[nodiscard]] MadeWorld street();
/// Two walls along x without end, and the ground: nothing says how far one has come.
[[nodiscard]] MadeWorld corridor();

/// A rough field without end and nothing on it.
[[nodiscard]] MadeWorld bare_ground();

using Motion = std::function<SE3(Time)>;  ///< T_world_lidar

struct MadeSensor {
  int rows = 32;
  int columns = 512;
  double up_deg = 22.5;
  double down_deg = -32.5;
  Time period = 100'000'000;
  double range_noise_m = 0;
  double max_range_m = 100;
};

/// What the sensor sees while it moves, columns in the order of time, the last one at `stamp`.
[[nodiscard]] lidar::Scan scan(const MadeWorld& world, const MadeSensor& sensor,
                               const Motion& motion, Time stamp);

/// Samples at 100 Hz over (begin, end], by differences of the motion.
[[nodiscard]] std::vector<lidar::ImuSample> imu(const Motion& motion, Time begin, Time end,
                                                const Eigen::Vector3d& gyro_bias);

/// A flight through the street: 4 m/s along x, weaving, turning its head by up to 1 rad/s, nodding.
[[nodiscard]] SE3 weaving(Time time);

/// Straight on along x at this speed, 1.8 m over the ground.
[[nodiscard]] Motion straight(double speed_mps);

}  // namespace saker::odometry::testing
