#pragma once

#include "saker/simulation/vehicle/quadrotor.h"

namespace saker::simulation {

/// Where to be and how to move there, z up.
struct FlightReference {
  Eigen::Vector3d position = Eigen::Vector3d::Constant(NAN);  ///< m
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();         ///< m/s
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();     ///< m/s²
  double yaw = 0;                                             ///< rad
  double yaw_rate = 0;                                        ///< rad/s
};

struct GeometricControllerConfig {
  double position_gain = 5.0;
  double velocity_gain = 4.0;
  double integral_gain = 1.2;
  double most_integral = 2.5;
  double most_position_error_m = 1.5;
  double attitude_gain = 110;
  double rate_gain = 20;
  double yaw_gain = 12;
  double yaw_rate_gain = 6;
  double turn_time_s = 0.03;
  double most_tilt_deg = 30;
  double least_thrust = 0.3;
  double most_thrust = 1.7;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("position_gain", position_gain, {0.1, 100}, "1/s²", "k_x / m: 0.35 Hz of bandwidth");
    v.field("velocity_gain", velocity_gain, {0.1, 100}, "1/s", "k_v / m: damped by 0.9");
    v.field("integral_gain", integral_gain, {0, 20}, "1/s³", "takes wind and weight off the error");
    v.field("most_integral", most_integral, {0, 10}, "m/s²", "that the integral may ask for");
    v.field("most_position_error_m", most_position_error_m, {0.1, 10}, "m",
            "a farther reference pulls no harder");
    v.field("attitude_gain", attitude_gain, {1, 2000}, "1/s²", "k_R / J of roll and pitch");
    v.field("rate_gain", rate_gain, {1, 500}, "1/s", "k_Ω / J of roll and pitch");
    v.field("yaw_gain", yaw_gain, {0.1, 500}, "1/s²", "k_R / J of yaw: drag torque is weak");
    v.field("yaw_rate_gain", yaw_rate_gain, {0.1, 500}, "1/s", "k_Ω / J of yaw");
    v.field("turn_time_s", turn_time_s, {0.005, 1}, "s",
            "over which the turn of the wanted attitude is taken: less than the lag of the motors");
    v.field("most_tilt_deg", most_tilt_deg, {5, 60}, "°", "of the thrust that is asked for");
    v.field("least_thrust", least_thrust, {0, 1}, "", "of the weight, so that it can turn");
    v.field("most_thrust", most_thrust, {1, 5}, "", "of the weight: leaves room for torques");
  }
};

/// Geometric tracking control on SE(3): Lee, Leok, McClamroch, "Geometric tracking control of a
/// quadrotor UAV on SE(3)", CDC 2010: errors eq. 10 and 11, thrust eq. 15, torque eq. 16 (without
/// the derivative of the wanted rate), with an integral of the position error after Goodarzi, Lee,
/// Lee, "Geometric nonlinear PID control", ECC 2013. Here z is up. Without the wanted rate of
/// eq. 11 the tilt would come 0.2 s late, and the vehicle would swing about where it stops.
class GeometricController {
 public:
  /// Throws Error on an invalid value.
  GeometricController(const GeometricControllerConfig& config, const AirframeConfig& airframe);

  /// Acceleration against gravity that is wanted of the rotors, m/s²: eq. 15 before it is
  /// projected.
  [[nodiscard]] Eigen::Vector3d track(const FlightReference& reference,
                                      const Eigen::Vector3d& position,
                                      const Eigen::Vector3d& velocity, double dt);

  /// The same where only the velocity is known: the integral stays as it is.
  [[nodiscard]] Eigen::Vector3d follow_velocity(const Eigen::Vector3d& wanted,
                                                const Eigen::Vector3d& velocity) const;

  /// How fast the wanted attitude turns, rad/s, z up: once for each reading.
  [[nodiscard]] Eigen::Vector3d turn(const Eigen::Vector3d& wanted, double yaw_rate, double dt);

  /// Motor thrusts that turn the body's z to `wanted` and its x to `yaw`, eq. 15 and 16.
  /// \param turn  of the two
  [[nodiscard]] MotorThrusts thrusts(const Eigen::Vector3d& wanted, double yaw,
                                     const Eigen::Vector3d& turn, const Eigen::Matrix3d& R,
                                     const Eigen::Vector3d& angular_velocity) const;

  void forget() { integral_.setZero(); }

 private:
  [[nodiscard]] Eigen::Vector3d limited(const Eigen::Vector3d& wanted) const;
  [[nodiscard]] MotorThrusts allocate(double thrust, const Eigen::Vector3d& torque) const;

  GeometricControllerConfig config_;
  AirframeConfig airframe_;
  Eigen::Matrix4d inverse_allocation_;
  Eigen::Vector3d integral_ = Eigen::Vector3d::Zero();  // m/s²
  Eigen::Vector3d late_up_ = Eigen::Vector3d::UnitZ();  // wanted z, as late as `turn_time_s`
};

}  // namespace saker::simulation
