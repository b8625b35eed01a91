#include "autonomy/supervisor.h"

#include <algorithm>
#include <utility>

namespace saker::autonomy {

Supervisor::Supervisor(const SafetyConfig& safety, const MissionConfig& mission,
                       const motion::Geofence& geofence)
    : height_m_(mission.height_m), safety_(safety, geofence), mission_(mission) {}

SafetyInput Supervisor::safety_input(const SupervisorInput& input) const {
  SafetyInput result;
  result.now = input.now;
  result.heard = input.heard;
  result.vehicle = input.vehicle;
  result.odometry = input.odometry;
  result.setpoint = input.setpoint;
  result.flying = mission_.flying();
  result.planning_due = planning_since_ != 0;
  result.heard.planning = std::max(result.heard.planning, planning_since_);
  result.place = input.T_world_odom * input.odometry.T_odom_body.translation();
  // Between ground and flight height the geofence's floor does not hold: its walls do.
  const MissionPhase phase = mission_.phase();
  const bool level = phase == MissionPhase::tour || phase == MissionPhase::return_home ||
                     phase == MissionPhase::hold;
  if (!level) result.place.z() = height_m_;
  return result;
}

Mission::Output Supervisor::step(SupervisorInput input) {
  const SafetyInput seen = safety_input(input);
  MissionInput mission;
  mission.now = input.now;
  mission.vehicle = input.vehicle;
  mission.odometry = input.odometry;
  mission.acks = std::move(input.acks);
  mission.planning = std::move(input.planning);
  mission.stop = std::move(input.stop);
  mission.plant_heard = std::max(input.heard.vehicle, input.heard.lidar);
  mission.land_ordered = input.land_ordered;
  mission.safety = safety_.update(seen);
  if (mission_.phase() == MissionPhase::preflight) {
    mission.findings = safety_.findings(seen);
    if (!input.has_targets) {
      mission.findings.push_back({Cause::no_targets, SafetyAction::none, "no target to map"});
    }
  }
  Mission::Output output = mission_.step(mission);
  if (output.orders.planning == PlanningOrder::none) {
    planning_since_ = 0;
  } else if (planning_since_ == 0) {
    planning_since_ = input.now;
  }
  return output;
}

}  // namespace saker::autonomy
