#pragma once

#include <string>

#include "flight/mavlink/line.h"
#include "saker/simulation/vehicle/simulated_vehicle.h"
#include "tools/sim/mavlink/autopilot.h"

namespace saker::tools {

/// The simulated vehicle behind an autopilot, on a line: `step` passes on what has come, what the
/// autopilot orders and what it says.
class MavlinkLine {
 public:
  /// Throws Error where the address is none. \param address  as `mavlink.line`
  MavlinkLine(const Quirks& quirks, const std::string& address, Time boot);

  /// \param state  the inner loops' newest
  void step(simulation::SimulatedVehicle& vehicle, const VehicleState& state);

  [[nodiscard]] const SimulatedAutopilot& autopilot() const { return autopilot_; }

 private:
  void read(Time vehicle_now);
  void log_changes();

  flight::mavlink::Line line_;
  SimulatedAutopilot autopilot_;
  std::uint32_t logged_mode_ = 0;
  flight::mavlink::Landed logged_landed_ = flight::mavlink::Landed::unknown;
};

}  // namespace saker::tools
