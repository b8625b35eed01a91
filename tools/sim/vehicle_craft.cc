#include "tools/sim/vehicle_craft.h"

namespace saker::tools {
namespace {

constexpr double kHold = 600;  // s: it is told where to be all the time

}  // namespace

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

void obey(simulation::SimulatedVehicle& vehicle, const CraftOrders& orders) {
  for (const VehicleOdometry& odometry : orders.odometry) vehicle.send(odometry);
  for (const Command& command : orders.commands) vehicle.send(command);
  if (orders.setpoint) vehicle.send(*orders.setpoint);
}

void put_behind(const Quirks& quirks, simulation::MissionConfig& mission) {
  mission.controller.hold_s = kHold;
  mission.controller.estimator.most_age_s = quirks.lost_s + quirks.failsafe_pause_s + 1;
}

}  // namespace saker::tools
