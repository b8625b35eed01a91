#pragma once

#include <algorithm>

#include "flight/mavlink/bridge.h"
#include "tools/plant/simulated_plant.h"
#include "tools/sim/mavlink/autopilot.h"
#include "tools/sim/vehicle_craft.h"

namespace saker::tools {

/// The simulated vehicle behind an autopilot and the bridge, on simulated time: bytes of MAVLink
/// between them, no socket. The host's clock is another than the vehicle's.
class MavlinkPlant : public autonomy::SteppedPlant {
 public:
  /// \param vehicle  of a mission that was put behind the same quirks
  MavlinkPlant(simulation::SimulatedVehicle& vehicle, const Quirks& quirks)
      : vehicle_(vehicle),
        packets_(vehicle),
        autopilot_(quirks, vehicle.now()),
        bridge_(config_of(quirks)) {}

  [[nodiscard]] Time now() const override { return vehicle_.now(); }
  void step_to(Time time) override {
    constexpr Time kStep = 2'000'000;
    while (vehicle_.now() < time) {
      vehicle_.step_to(std::min(vehicle_.now() + kStep, time));
      exchange();
    }
  }

  [[nodiscard]] std::vector<autonomy::SensorPacket> take_packets() override {
    return packets_.take_packets();
  }
  /// At 50 Hz, as the process says it.
  [[nodiscard]] std::optional<VehicleState> take_state() override {
    if (now() < next_state_) return std::nullopt;
    next_state_ = now() + 20'000'000;
    return bridge_.vehicle_state(host());
  }
  [[nodiscard]] std::vector<CommandAck> take_acks() override {
    return bridge_.take_answers(host());
  }

  void send(const VehicleOdometry& odometry) override { bridge_.hear(odometry, host()); }
  void send(const Setpoint& setpoint) override { bridge_.hear(setpoint, host()); }
  void send(const Command& command) override { bridge_.hear(command, host()); }

  [[nodiscard]] const flight::mavlink::Bridge& bridge() const { return bridge_; }
  [[nodiscard]] const SimulatedAutopilot& autopilot() const { return autopilot_; }
  /// A pilot's switch.
  void switch_mode(std::uint32_t custom_mode) { autopilot_.switch_mode(custom_mode); }
  /// Modes that it was in, in their order.
  [[nodiscard]] const std::vector<std::uint32_t>& modes() const { return modes_; }

 private:
  static flight::mavlink::BridgeConfig config_of(const Quirks& quirks) {
    flight::mavlink::BridgeConfig config;
    config.autopilot = quirks.dialect.autopilot;
    return config;
  }

  [[nodiscard]] Time host() const { return vehicle_.now() + 777 * kNanosecondsPerSecond; }

  void exchange() {
    if (const auto state = vehicle_.take_state()) inner_ = *state;
    (void)vehicle_.take_acks();
    if (inner_.stamp == 0) return;
    autopilot_.step(now(), craft_of(vehicle_, inner_));
    obey(vehicle_, autopilot_.take_orders());
    for (const auto& frame : autopilot_.take_frames()) bridge_.hear_bytes(frame.span(), host(), 0);
    bridge_.step(host(), 0);
    for (const auto& frame : bridge_.take_frames()) autopilot_.hear_bytes(frame.span(), now());
    if (modes_.empty() || modes_.back() != autopilot_.mode()) modes_.push_back(autopilot_.mode());
  }

  simulation::SimulatedVehicle& vehicle_;
  SimulatedPlant packets_;
  SimulatedAutopilot autopilot_;
  flight::mavlink::Bridge bridge_;
  VehicleState inner_;
  Time next_state_ = 0;
  std::vector<std::uint32_t> modes_;
};

}  // namespace saker::tools
