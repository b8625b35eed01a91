#pragma once

#include <functional>
#include <vector>

#include "saker/core/rng.h"
#include "saker/lidar/scan.h"
#include "saker/simulation/sensor/sensor_config.h"

/// What given paths are made of: flights that nobody controls. Analytic in time, so that every
/// derivative exists.
namespace saker::simulation {

/// From 0 to 1 with two continuous derivatives.
[[nodiscard]] double smooth_step(double x);
/// Its integral from 0.
[[nodiscard]] double smooth_step_integral(double x);

/// Seconds of cruise that a flight of `duration_s` is worth after `t` seconds: it hovers at both
/// ends for kHover and comes to its speed, and to rest, within kRamp.
[[nodiscard]] double cruised_s(double t, double duration_s);
inline constexpr double kHover = 1.5;
inline constexpr double kRamp = 2.5;

struct Swing {
  double amplitude, period, phase;
  [[nodiscard]] double at(double t) const;
};
/// Of a period between two, of any phase.
[[nodiscard]] Swing random_swing(double amplitude, double shortest, double longest, core::Rng& rng);

/// Attitude and place at `t` of a multirotor that follows `position` (m, z up, any t): it leans
/// into its acceleration and against the drag. x points to `heading`.
[[nodiscard]] SE3 leaning_pose(const std::function<Eigen::Vector3d(double t)>& position,
                               double heading, double t);

using PathPose = std::function<SE3(double t)>;  ///< T_sim_lidar, t seconds after the start

/// What an inertial unit at `T_lidar_imu` of the sensor reads along the path: specific force and
/// turn rate in the lidar frame's axes, with noise and a constant bias.
[[nodiscard]] std::vector<lidar::ImuSample> simulate_imu(const PathPose& path,
                                                         const ImuConfig& config,
                                                         const SE3& T_lidar_imu, double duration_s,
                                                         Time start, core::Rng& rng);

}  // namespace saker::simulation
