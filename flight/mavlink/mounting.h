#pragma once

#include <vector>

#include "saker/core/vehicle.h"

/// Where the autopilot is on the body, T_body_autopilot: what we say of the body ↔ what it holds
/// for itself.
///
/// Reads and makes odometry and setpoints in `odom`, attitudes in a level frame; `autopilot` is
/// FLU as `body` is. All of it is rigid-body mathematics: T_odom_autopilot = T_odom_body ·
/// T_body_autopilot, v_autopilot = v_body + R_odom_body (ω × p_body_autopilot); the covariance is
/// turned by the adjoint of the inverse. The rotation is what is left of the mounting beside the
/// autopilot's own (AHRS_ORIENTATION, SENS_BOARD_ROT). A body that is not level is taken as level
/// in setpoints: at a tilt of 10° and 0.1 m beside the body's origin that is 0.02 m.
namespace saker::flight::mavlink {

class Mounting {
 public:
  /// Throws Error when there are not three numbers each.
  /// \param place_m  of the autopilot in body
  /// \param rotation_deg  its roll, pitch and yaw in body: about z, then y, then x
  Mounting(const std::vector<double>& place_m, const std::vector<double>& rotation_deg);

  /// Of the body → of the autopilot. What is no number stays none.
  [[nodiscard]] VehicleOdometry odometry(VehicleOdometry of_body) const;
  [[nodiscard]] Setpoint setpoint(Setpoint of_body) const;

  /// The autopilot's attitude → the body's.
  [[nodiscard]] Eigen::Quaterniond attitude(const Eigen::Quaterniond& of_autopilot) const;

 private:
  SE3 T_body_autopilot_ = SE3::Identity();
  Matrix6d adjoint_ = Matrix6d::Identity();  // of its inverse
  double yaw_ = 0;                           // of it
};

}  // namespace saker::flight::mavlink
