#include "tools/sim/mavlink_line.h"

#include <spdlog/spdlog.h>

#include <array>
#include <chrono>

namespace saker::tools {
namespace {

constexpr int kMostReads = 64;  // datagrams in one step

Time host_now() {
  using namespace std::chrono;
  return duration_cast<nanoseconds>(steady_clock::now().time_since_epoch()).count();
}

CraftState craft_of(const simulation::SimulatedVehicle& vehicle, const VehicleState& state) {
  const simulation::OdometryEstimator& at = vehicle.odometry();
  CraftState craft;
  craft.vehicle = state;
  craft.T_odom_body.linear() = at.attitude();
  craft.T_odom_body.translation() = at.position();
  craft.velocity = at.velocity();
  craft.angular_velocity = at.angular_velocity();
  return craft;
}

}  // namespace

MavlinkLine::MavlinkLine(const Quirks& quirks, const std::string& address, Time boot)
    : line_(flight::mavlink::parsed_address(address)), autopilot_(quirks, boot) {}

void MavlinkLine::read(Time vehicle_now) {
  std::array<std::uint8_t, 2048> buffer;
  for (int i = 0; i < kMostReads; ++i) {
    const auto bytes = line_.read(buffer, host_now());
    if (bytes.empty()) return;
    autopilot_.hear_bytes(bytes, vehicle_now);
  }
}

void MavlinkLine::step(simulation::SimulatedVehicle& vehicle, const VehicleState& state) {
  line_.step(host_now());
  read(vehicle.now());
  autopilot_.step(vehicle.now(), craft_of(vehicle, state));
  const CraftOrders orders = autopilot_.take_orders();
  for (const VehicleOdometry& odometry : orders.odometry) vehicle.send(odometry);
  for (const Command& command : orders.commands) vehicle.send(command);
  if (orders.setpoint) vehicle.send(*orders.setpoint);
  for (const auto& frame : autopilot_.take_frames()) line_.write(frame.span());
  log_changes();
}

void MavlinkLine::log_changes() {
  const auto mode = autopilot_.mode();
  const auto landed = autopilot_.landed();
  if (mode == logged_mode_ && landed == logged_landed_) return;
  logged_mode_ = mode;
  logged_landed_ = landed;
  spdlog::info("autopilot: mode {}, landed state {}", mode, static_cast<int>(landed));
}

}  // namespace saker::tools
