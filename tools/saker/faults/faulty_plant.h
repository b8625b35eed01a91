#pragma once

#include <functional>
#include <optional>

#include "saker/simulation/vehicle/simulated_vehicle.h"
#include "tools/plant/simulated_plant.h"
#include "tools/saker/faults/faulty_line.h"
#include "tools/saker/faults/packet_faults.h"

namespace saker::tools {

/// The simulated vehicle behind channels that fail: what comes from it and what is sent to it is
/// lost, late, there twice, stuck or nonsense, as the schedule says.
class FaultyPlant : public autonomy::SteppedPlant {
 public:
  /// Hears the vehicle's own truth and state at each step of 10 ms, odometry as it was sent, and
  /// what the flight controller answered.
  struct Ears {
    std::function<void(const simulation::VehicleTruth&, const VehicleState&)> step;
    std::function<void(const VehicleOdometry&)> odometry;
    std::function<void(const CommandAck&)> ack;
  };

  /// `vehicle` and `schedule` have to outlive this.
  FaultyPlant(simulation::SimulatedVehicle& vehicle, const FaultSchedule& schedule, Ears ears);

  [[nodiscard]] Time now() const override { return plant_.now(); }
  void step_to(Time time) override;

  [[nodiscard]] std::vector<autonomy::SensorPacket> take_packets() override;
  [[nodiscard]] std::optional<VehicleState> take_state() override;
  [[nodiscard]] std::vector<CommandAck> take_acks() override;

  void send(const VehicleOdometry& odometry) override;
  void send(const Setpoint& setpoint) override;
  void send(const Command& command) override;

  [[nodiscard]] double mission_s() const { return to_seconds(plant_.now() - begin_); }

 private:
  void deliver();
  [[nodiscard]] VehicleState told(VehicleState state);
  [[nodiscard]] bool acts(FaultKind kind, FaultPlace place = FaultPlace::none) const {
    return acting(schedule_, kind, place, mission_s()) != nullptr;
  }

  simulation::SimulatedVehicle& vehicle_;
  SimulatedPlant plant_;
  const FaultSchedule& schedule_;
  Ears ears_;
  Time begin_;
  PacketFaults packet_faults_;
  core::Rng rng_;
  VehicleState state_;                       // the vehicle's own, the newest
  std::optional<VehicleState> stuck_state_;  // as told again and again
  std::optional<VehicleOdometry> stuck_odometry_;
  FaultyLine<autonomy::SensorPacket> lidar_, imu_;
  FaultyLine<VehicleState> states_;
  FaultyLine<CommandAck> acks_;
  FaultyLine<VehicleOdometry> odometry_;
  FaultyLine<Setpoint> setpoints_;
  FaultyLine<Command> commands_;
};

}  // namespace saker::tools
