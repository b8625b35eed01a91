#pragma once

#include <algorithm>

#include "tools/sim/mavlink/craft.h"

namespace saker::tools {

/// A vehicle without inner loops, in made time: it does what it is ordered, at the speeds of the
/// records. What it takes for its place in `odom` is off by what odometry says.
class MadeCraft {
 public:
  double climb_mps = 0.93, land_mps = 0.5, most_mps = 2;

  void obey(const CraftOrders& orders) {
    for (const VehicleOdometry& o : orders.odometry) offset_ = o.T_odom_body.translation() - true_;
    for (const Command& command : orders.commands) obey(command);
    if (orders.setpoint) setpoint_ = orders.setpoint;
  }

  void step(double dt) {
    velocity_.setZero();
    if (mode_ == VehicleMode::takeoff) climb();
    if (mode_ == VehicleMode::land) velocity_.z() = -land_mps;
    if (setpoint_ && (mode_ == VehicleMode::hold || mode_ == VehicleMode::guided)) follow();
    true_ += dt * velocity_;
    if (mode_ != VehicleMode::land || true_.z() > 0) return;
    true_.z() = 0;
    armed_ = false;
    mode_ = VehicleMode::idle;
  }

  [[nodiscard]] CraftState state() const {
    CraftState state;
    state.vehicle.armed = armed_;
    state.vehicle.mode = mode_;
    state.vehicle.battery_share = 0.9;
    state.T_odom_body.translation() = true_ + offset_;
    state.velocity = velocity_;
    return state;
  }
  /// In the `odom` of the beginning.
  [[nodiscard]] const Eigen::Vector3d& place() const { return true_; }
  [[nodiscard]] const Eigen::Vector3d& velocity() const { return velocity_; }

 private:
  void obey(const Command& command) {
    switch (command.kind) {
      case CommandKind::arm:
        armed_ = true;
        return;
      case CommandKind::disarm:
        armed_ = false;
        mode_ = VehicleMode::idle;
        return;
      case CommandKind::takeoff:
        mode_ = VehicleMode::takeoff;
        top_ = true_.z() + command.height_m;
        return;
      case CommandKind::hold:
        mode_ = VehicleMode::hold;
        return;
      case CommandKind::land:
        if (mode_ != VehicleMode::idle) mode_ = VehicleMode::land;
        return;
      case CommandKind::resume:
        return;
    }
  }

  void climb() {
    if (true_.z() < top_)
      velocity_.z() = climb_mps;
    else
      mode_ = VehicleMode::hold;
  }

  void follow() {
    mode_ = VehicleMode::guided;
    const Eigen::Vector3d off = setpoint_->position - offset_ - true_;
    velocity_ = setpoint_->velocity + 2 * off;
    if (velocity_.norm() > most_mps) velocity_ *= most_mps / velocity_.norm();
  }

  Eigen::Vector3d true_ = Eigen::Vector3d::Zero(), offset_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();
  std::optional<Setpoint> setpoint_;
  double top_ = 0;
  bool armed_ = false;
  VehicleMode mode_ = VehicleMode::idle;
};

}  // namespace saker::tools
