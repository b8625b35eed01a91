#pragma once

#include "saker/simulation/vehicle/simulated_vehicle.h"
#include "tools/sim/mavlink/craft.h"
#include "tools/sim/mavlink/quirks.h"

/// The simulated vehicle as the craft below an autopilot.
namespace saker::tools {

/// What the flight controller knows. \param state  its newest
[[nodiscard]] CraftState craft_of(const simulation::SimulatedVehicle& vehicle,
                                  const VehicleState& state);
void obey(simulation::SimulatedVehicle& vehicle, const CraftOrders& orders);

/// The flight controller obeys, and the autopilot alone has time-outs.
void put_behind(const Quirks& quirks, simulation::MissionConfig& mission);

}  // namespace saker::tools
