#pragma once

#include <chrono>

#include "flight/bus/bus.h"
#include "flight/bus/presence.h"
#include "saker/simulation/vehicle/simulated_vehicle.h"
#include "tools/sim/mavlink_line.h"
#include "tools/sim/sim_recorder.h"
#include "tools/sim/udp_sender.h"

namespace saker::tools {

struct RealTimeOptions {
  double factor = 1;  ///< simulated seconds a second
  int lidar_port = 7502;
  int imu_port = 7503;
};

/// The simulated vehicle on the clock of this machine: every 2 ms what the network said goes in,
/// time goes on, what the sensor and the flight controller say goes out. One thread, absolute
/// deadlines. Where the machine is too slow simulated time falls behind, is counted, and goes on
/// from there.
class RealTime {
 public:
  using Steady = std::chrono::steady_clock;

  /// \param mavlink  not null: the vehicle obeys it alone, and nothing of the bus
  RealTime(simulation::SimulatedVehicle& vehicle, flight::Bus& bus, flight::Presence& presence,
           const RealTimeOptions& options, MavlinkLine* mavlink = nullptr);

  /// Until `stop` says so or the vehicle has flown, landed and disarmed. Throws Error when the
  /// network goes away.
  SimRecorder::Run run(SimRecorder& recorder, const std::function<bool()>& stop);

 private:
  void subscribe();
  void advance();
  void send_packets();
  void send_states();
  void serve_mavlink();
  void log_change(const VehicleState& state);
  void log_events();
  [[nodiscard]] bool is_over() const;

  simulation::SimulatedVehicle& vehicle_;
  flight::Bus& bus_;
  flight::Presence& presence_;
  RealTimeOptions options_;
  MavlinkLine* mavlink_;
  UdpSender lidar_;
  UdpSender imu_;

  Steady::time_point origin_;  // when simulated time was `begin_`
  Time begin_;
  double behind_s_ = 0;
  VehicleState last_state_;
  VehicleState inner_state_;  // below the autopilot
  int events_begun_ = 0;
  Time disarmed_at_ = 0;  // after a flight
};

}  // namespace saker::tools
