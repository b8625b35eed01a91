#pragma once

#include "saker/autonomy/stepped.h"
#include "saker/simulation/vehicle/simulated_vehicle.h"

namespace saker::tools {

/// The simulated vehicle as the autonomy's plant, in one process on simulated time.
class SimulatedPlant : public autonomy::SteppedPlant {
 public:
  explicit SimulatedPlant(simulation::SimulatedVehicle& vehicle) : vehicle_(vehicle) {}

  [[nodiscard]] Time now() const override { return vehicle_.now(); }
  void step_to(Time time) override { vehicle_.step_to(time); }

  [[nodiscard]] std::vector<autonomy::SensorPacket> take_packets() override;
  [[nodiscard]] std::optional<VehicleState> take_state() override { return vehicle_.take_state(); }
  [[nodiscard]] std::vector<CommandAck> take_acks() override { return vehicle_.take_acks(); }

  void send(const VehicleOdometry& odometry) override { vehicle_.send(odometry); }
  void send(const Setpoint& setpoint) override { vehicle_.send(setpoint); }
  void send(const Command& command) override { vehicle_.send(command); }

 private:
  simulation::SimulatedVehicle& vehicle_;
};

}  // namespace saker::tools
