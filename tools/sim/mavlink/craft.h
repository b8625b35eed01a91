#pragma once

#include <optional>
#include <vector>

#include "saker/core/vehicle.h"

/// What lies below the autopilot's MAVLink: the vehicle with its inner loops, as plain structs.
namespace saker::tools {

/// What the inner loops know. Places in `odom`, as the estimator has them.
struct CraftState {
  VehicleState vehicle;
  SE3 T_odom_body = SE3::Identity();
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();  ///< body
};

/// What the autopilot wants of them, in this order. Stamps are the vehicle's clock.
struct CraftOrders {
  std::vector<VehicleOdometry> odometry;
  std::vector<Command> commands;
  std::optional<Setpoint> setpoint;
};

}  // namespace saker::tools
