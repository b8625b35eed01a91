#pragma once

#include "saker/simulation/sensor/sensor_config.h"
#include "saker/simulation/vehicle/quadrotor.h"
#include "saker/simulation/vehicle/vehicle_estimator.h"

namespace saker::simulation {

/// Readings at 500 Hz of a unit that begins at `kBegin`.
inline constexpr double kStep = 0.002;
inline constexpr Time kBegin = kNanosecondsPerSecond;
inline const Eigen::Vector3d kRest(0, 0, kStandardGravity);  ///< what is read standing still

/// A unit without noise and bias.
inline const ImuConfig kExact{.rate_hz = 100,
                              .acceleration_noise = 0,
                              .rotation_noise = 0,
                              .acceleration_bias = 0,
                              .rotation_bias = 0};

inline int steps_of(double seconds) { return static_cast<int>(std::lround(seconds / kStep)); }
inline Time time_of(int step) { return kBegin + step * from_seconds(kStep); }

inline lidar::ImuSample reading(int step, const Eigen::Vector3d& force,
                                const Eigen::Vector3d& rate) {
  return {time_of(step), force, rate};
}

/// Odometry of a body that does not turn.
inline VehicleOdometry odometry_at(int step, const Eigen::Vector3d& position,
                                   const Eigen::Vector3d& velocity) {
  VehicleOdometry odometry;
  odometry.stamp = time_of(step);
  odometry.T_odom_body.translation() = position;
  odometry.velocity = velocity;
  odometry.status = VehicleOdometryStatus::ok;
  return odometry;
}

}  // namespace saker::simulation
