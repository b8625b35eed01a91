#pragma once

#include "saker/simulation/vehicle/simulated_vehicle.h"

namespace saker::simulation {

/// Flies a simulated vehicle on odometry that is the truth, as an executive would: for tests of the
/// simulator.
class Pilot {
 public:
  Pilot(const MissionConfig& config, std::uint64_t seed) : vehicle(config, seed) {}

  /// 10 ms.
  void step() {
    vehicle.step_to(vehicle.now() + from_seconds(0.01));
    const VehicleTruth truth = vehicle.truth();
    VehicleOdometry odometry;
    odometry.stamp = vehicle.now();
    odometry.T_odom_body = truth.T_world_body;
    odometry.velocity = truth.velocity;
    odometry.status = VehicleOdometryStatus::ok;
    vehicle.send(odometry);
    if (const auto state = vehicle.take_state()) vehicle_state = *state;
  }
  void run(double seconds) {
    const Time end = vehicle.now() + from_seconds(seconds);
    while (vehicle.now() < end) step();
  }

  bool command(CommandKind kind, double height_m = NAN) {
    vehicle.send(Command{vehicle.now(), ++last_id_, kind, height_m});
    return vehicle.take_acks().back().accepted;
  }

  /// \return whether it holds at `height` within 15 s.
  bool take_off(double height) {
    run(0.5);
    if (!command(CommandKind::arm) || !command(CommandKind::takeoff, height)) return false;
    const Time end = vehicle.now() + from_seconds(15);
    while (vehicle.now() < end && vehicle_state.mode != VehicleMode::hold) step();
    return vehicle_state.mode == VehicleMode::hold;
  }

  void guide(const Eigen::Vector3d& position, double seconds,
             const Eigen::Vector3d& velocity = Eigen::Vector3d::Zero()) {
    const Time end = vehicle.now() + from_seconds(seconds);
    while (vehicle.now() < end) {
      vehicle.send(Setpoint{vehicle.now(), vehicle.now() + from_seconds(0.2), position, velocity,
                            Eigen::Vector3d::Zero(), 0, 0});
      step();
      step();
    }
  }
  /// Straight there, then `stay` seconds there.
  void fly_to(const Eigen::Vector3d& place, double speed, double stay = 1) {
    const Eigen::Vector3d from = vehicle.truth().T_world_body.translation();
    const double length = (place - from).norm();
    const Eigen::Vector3d velocity = speed / length * (place - from);
    for (double t = 0; t * speed < length; t += 0.02) guide(from + t * velocity, 0.02, velocity);
    guide(place, stay);
  }

  SimulatedVehicle vehicle;
  VehicleState vehicle_state;

 private:
  std::int64_t last_id_ = 0;
};

}  // namespace saker::simulation
