#include "tools/sim/mavlink_line.h"

#include <spdlog/spdlog.h>

#include <array>
#include <chrono>

#include "tools/sim/vehicle_craft.h"

namespace saker::tools {
namespace {

constexpr int kMostReads = 64;  // datagrams in one step

Time host_now() {
  using namespace std::chrono;
  return duration_cast<nanoseconds>(steady_clock::now().time_since_epoch()).count();
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
  obey(vehicle, autopilot_.take_orders());
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
