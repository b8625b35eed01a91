#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <vector>

#include "core/config.h"
#include "core/rng.h"
#include "core/se3.h"

namespace saker::simulation {

/// How a quadrotor flies a list of waypoints.
struct FlightPathConfig {
  double speed_m_s = 3;
  double ramp_s = 2;
  double knot_s = 0.8;
  double sway_m = 0.03;
  double vibration_deg = 0.15;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("speed_m_s", speed_m_s, {0.1, 15}, "m/s", "cruise speed along the waypoints");
    v.field("ramp_s", ramp_s, {0.1, 20}, "s", "from rest to cruise speed and back");
    v.field("knot_s", knot_s, {0.2, 5}, "s",
            "spacing of the spline's knots: how gently corners are flown");
    v.field("sway_m", sway_m, {0, 1}, "m", "amplitude of the slow wander about the path: wind");
    v.field("vibration_deg", vibration_deg, {0, 5}, "deg",
            "amplitude of the airframe's 7–13 Hz wobble");
  }
};

/// A waypoint in the world frame; the heading is unwrapped by the caller's order (the shorter way
/// is flown).
struct Waypoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< m
  double yaw = 0;                                      ///< rad
};

/// The motion of a quadrotor through waypoints: uniform cubic B-splines of position and yaw over
/// time, roll and pitch from the acceleration (differential flatness; Mellinger and Kumar, ICRA
/// 2011, eq. 6–8), plus wind sway and vibration. Body = lidar. Smooth to the second derivative, so
/// that an inertial unit on it reads finite values.
class FlightPath {
 public:
  /// At least two waypoints; throws Error otherwise. `rng` decides the phases of sway and
  /// vibration.
  FlightPath(const FlightPathConfig& config, const std::vector<Waypoint>& waypoints, core::Rng rng);

  [[nodiscard]] double duration() const;           ///< s, from rest to rest
  [[nodiscard]] SE3 T_world_body(double t) const;  ///< t is clamped to 0 … duration
  [[nodiscard]] Eigen::Vector3d acceleration(
      double t) const;  ///< world frame, without gravity, m/s²
  [[nodiscard]] Eigen::Vector3d angular_velocity(double t) const;  ///< body frame, rad/s

 private:
  [[nodiscard]] Eigen::Vector4d spline(double t) const;  ///< x, y, z, yaw
  [[nodiscard]] Eigen::Vector3d position(double t) const;

  FlightPathConfig config_;
  std::vector<Eigen::Vector4d> knots_;
  std::array<double, 6> phases_{};
};

/// An inertial unit of the kind that is built into the sensor (ICM-20948).
struct ImuConfig {
  double rate_hz = 100;
  double gyro_noise = 0.00026;
  double gyro_bias = 0.005;
  double gyro_bias_walk = 0.00002;
  double accelerometer_noise = 0.0023;
  double accelerometer_bias = 0.05;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("rate_hz", rate_hz, {10, 1000}, "Hz", "samples a second");
    v.field("gyro_noise", gyro_noise, {0, 1}, "rad/s/√Hz",
            "white noise: 0.015 deg/s/√Hz in the data sheet");
    v.field("gyro_bias", gyro_bias, {0, 1}, "rad/s",
            "sd of the turn-on bias, after the maker's calibration");
    v.field("gyro_bias_walk", gyro_bias_walk, {0, 1}, "rad/s²/√Hz", "random walk of the bias");
    v.field("accelerometer_noise", accelerometer_noise, {0, 1}, "m/s²/√Hz",
            "white noise: 230 µg/√Hz");
    v.field("accelerometer_bias", accelerometer_bias, {0, 5}, "m/s²", "sd of the turn-on bias");
  }
};

struct ImuReading {
  double t = 0;                                                     ///< s since the flight's start
  Eigen::Vector3d specific_force = Eigen::Vector3d::Constant(NAN);  ///< body frame, m/s²
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Constant(NAN);  ///< body frame, rad/s
};

/// Readings over the whole flight, with turn-on bias, bias walk and white noise.
[[nodiscard]] std::vector<ImuReading> read_imu(const ImuConfig& config, const FlightPath& path,
                                               core::Rng rng);

}  // namespace saker::simulation
