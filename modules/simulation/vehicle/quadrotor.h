#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "saker/core/config.h"
#include "saker/core/se3.h"

namespace saker::simulation {

inline constexpr double kStandardGravity = 9.80665;

/// A quadrotor of the paper's size, with computer, battery and an OS1 on top.
struct AirframeConfig {
  double mass_kg = 3.2;
  double inertia_roll = 0.045;
  double inertia_pitch = 0.045;
  double inertia_yaw = 0.075;
  double arm_m = 0.25;
  double most_thrust_n = 17;
  double torque_per_thrust_m = 0.016;
  double motor_lag_s = 0.04;
  double rotor_drag = 0.35;
  double air_drag = 0.04;
  double leg_m = 0.2;
  double radius_m = 0.4;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("mass_kg", mass_kg, {0.2, 50}, "kg", "everything that flies");
    v.field("inertia_roll", inertia_roll, {1e-4, 10}, "kg m²", "about x");
    v.field("inertia_pitch", inertia_pitch, {1e-4, 10}, "kg m²", "about y");
    v.field("inertia_yaw", inertia_yaw, {1e-4, 10}, "kg m²", "about z");
    v.field("arm_m", arm_m, {0.05, 2}, "m", "from the centre to a motor, at 45° to x");
    v.field("most_thrust_n", most_thrust_n, {0.5, 500}, "N",
            "of one motor: twice what hovering takes");
    v.field("torque_per_thrust_m", torque_per_thrust_m, {1e-4, 0.2}, "m", "about z, of a rotor");
    v.field("motor_lag_s", motor_lag_s, {0.001, 1}, "s", "time constant of a rotor's thrust");
    v.field("rotor_drag", rotor_drag, {0, 10}, "kg/s",
            "force in the rotors' plane per speed through the air");
    v.field("air_drag", air_drag, {0, 10}, "kg/m", "force of the body per squared speed");
    v.field("leg_m", leg_m, {0.02, 2}, "m", "height of the body's origin where it stands");
    v.field("radius_m", radius_m, {0.05, 3}, "m", "of the sphere about body and propellers");
  }

  [[nodiscard]] Eigen::Vector3d inertia() const {
    return {inertia_roll, inertia_pitch, inertia_yaw};
  }
};

/// Thrusts of the four motors, N: front left, rear left, rear right, front right.
using MotorThrusts = Eigen::Array4d;

/// [collective thrust, torque about x, y, z] of the motors' thrusts.
[[nodiscard]] Eigen::Matrix4d allocation(const AirframeConfig& airframe);

/// Where the body is and how it moves.
struct RigidState {
  SE3 pose = SE3::Identity();                                      ///< T_sim_body
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();              ///< m/s, sim
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();      ///< rad/s, body
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();          ///< m/s², sim, gravity included
  Eigen::Vector3d angular_acceleration = Eigen::Vector3d::Zero();  ///< rad/s², body
};

/// A rigid body with four motors of first order and limited thrust, drag of the rotors in their
/// plane (Faessler, Franchi, Scaramuzza, RA-L 2018, eq. 3) and of the body, and four legs that
/// stand on the ground by spring, damper and dry friction.
///
/// Semi-implicit Euler; 1 ms steps are stable for the legs. About 0.3 µs a step.
class Quadrotor {
 public:
  /// Height of the ground under each foot, m.
  using GroundHeights = std::array<double, 4>;

  /// Throws Error on an invalid value.
  Quadrotor(const AirframeConfig& airframe, const SE3& T_sim_body);

  /// `dt` seconds on. Thrusts out of the motors' limits are cut.
  void step(double dt, const MotorThrusts& commanded, const Eigen::Vector3d& wind,
            const GroundHeights& ground);

  [[nodiscard]] const RigidState& state() const { return state_; }
  [[nodiscard]] const MotorThrusts& thrusts() const { return thrusts_; }
  [[nodiscard]] std::array<Eigen::Vector3d, 4> feet() const;  ///< sim
  [[nodiscard]] bool on_ground() const { return feet_down_ > 0; }
  /// m/s, downwards, at the last time that a foot came down after all had been in the air.
  [[nodiscard]] double touchdown_speed() const { return touchdown_speed_; }

 private:
  struct Wrench {
    Eigen::Vector3d force = Eigen::Vector3d::Zero();   // sim
    Eigen::Vector3d torque = Eigen::Vector3d::Zero();  // body
  };

  [[nodiscard]] Wrench rotors() const;
  [[nodiscard]] Eigen::Vector3d drag(const Eigen::Vector3d& wind) const;
  [[nodiscard]] Wrench legs(const GroundHeights& ground);
  void integrate(double dt, const Wrench& wrench);
  [[nodiscard]] bool sticks() const;

  AirframeConfig airframe_;
  Eigen::Matrix4d allocation_;
  RigidState state_;
  MotorThrusts thrusts_ = MotorThrusts::Zero();
  int feet_down_ = 0;
  double touchdown_speed_ = 0;
};

}  // namespace saker::simulation
