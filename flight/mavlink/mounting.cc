#include "flight/mavlink/mounting.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "saker/core/error.h"

namespace saker::flight::mavlink {

using Eigen::AngleAxisd, Eigen::Matrix3d, Eigen::Vector3d;

Mounting::Mounting(const std::vector<double>& place_m, const std::vector<double>& rotation_deg) {
  if (place_m.size() != 3 || rotation_deg.size() != 3) {
    throw Error(
        fmt::format("mavlink: {} and {} numbers, expected three of place_m and three of "
                    "rotation_deg",
                    place_m.size(), rotation_deg.size()));
  }
  const Vector3d angles = Vector3d::Map(rotation_deg.data()) * std::numbers::pi / 180;
  T_body_autopilot_.linear() =
      (AngleAxisd(angles.z(), Vector3d::UnitZ()) * AngleAxisd(angles.y(), Vector3d::UnitY()) *
       AngleAxisd(angles.x(), Vector3d::UnitX()))
          .toRotationMatrix();
  T_body_autopilot_.translation() = Vector3d::Map(place_m.data());
  adjoint_ = core::se3_adjoint(T_body_autopilot_.inverse());
  yaw_ = core::yaw(T_body_autopilot_.linear());
}

VehicleOdometry Mounting::odometry(VehicleOdometry of_body) const {
  const Matrix3d R_odom_body = of_body.T_odom_body.linear();
  const Vector3d lever = T_body_autopilot_.translation();
  VehicleOdometry of_autopilot = of_body;
  of_autopilot.T_odom_body = of_body.T_odom_body * T_body_autopilot_;
  of_autopilot.velocity += R_odom_body * of_body.angular_velocity.cross(lever);
  of_autopilot.angular_velocity = T_body_autopilot_.linear().transpose() * of_body.angular_velocity;
  of_autopilot.covariance = adjoint_ * of_body.covariance * adjoint_.transpose();
  return of_autopilot;
}

/// Level, and turning about z at the setpoint's rate.
Setpoint Mounting::setpoint(Setpoint of_body) const {
  const Vector3d lever =
      AngleAxisd(of_body.yaw, Vector3d::UnitZ()) * T_body_autopilot_.translation();
  const Vector3d turning(0, 0, std::isnan(of_body.yaw_rate) ? 0 : of_body.yaw_rate);
  Setpoint of_autopilot = of_body;
  of_autopilot.position += lever;
  of_autopilot.velocity += turning.cross(lever);
  of_autopilot.acceleration += turning.cross(turning.cross(lever));
  of_autopilot.yaw += yaw_;
  return of_autopilot;
}

Eigen::Quaterniond Mounting::attitude(const Eigen::Quaterniond& of_autopilot) const {
  return of_autopilot * Eigen::Quaterniond(T_body_autopilot_.linear().transpose());
}

}  // namespace saker::flight::mavlink
