#include "saker/autonomy/supervisor.h"

#include <algorithm>
#include <utility>

namespace saker::autonomy {

Supervisor::Supervisor(const SafetyConfig& safety, const MissionConfig& mission,
                       const motion::Geofence& geofence)
    : config_(mission), safety_(safety, geofence), mission_(mission) {}

SafetyInput Supervisor::safety_input(const SupervisorInput& input) const {
  SafetyInput result;
  result.now = input.now;
  result.heard = input.heard;
  result.vehicle = input.vehicle;
  result.odometry = input.odometry;
  result.setpoint = input.setpoint;
  result.flying = mission_.flying() && !mission_.taken_over();
  result.planning_due = planning_since_ != 0;
  result.heard.planning = std::max(result.heard.planning, planning_since_);
  result.place = input.T_world_odom * input.odometry.T_odom_body.translation();
  // Between ground and flight height the geofence's floor does not hold: its walls do.
  const MissionPhase phase = mission_.phase();
  const bool level = phase == MissionPhase::tour || phase == MissionPhase::return_home ||
                     phase == MissionPhase::hold;
  if (!level) result.place.z() = config_.height_m;
  if (level) result.contact = input.contact;  // feet touch the ground, too
  return result;
}

/// What keeps it there: the ladder's findings, and what only matters before the flight.
std::vector<Finding> Supervisor::on_the_ground(const SupervisorInput& input,
                                               const SafetyInput& seen) const {
  std::vector<Finding> found = safety_.findings(seen);
  if ((input.vehicle.faults & kTakenOver) != 0) {
    found.push_back({Cause::taken_over, SafetyAction::none, "somebody else has it: resume"});
  }
  if (!input.has_targets) {
    found.push_back({Cause::no_targets, SafetyAction::none, "no target to map"});
  }
  find_column(found);
  const bool labelled = input.heard.mapping != 0;  // else the map is missing, which is said
  if (labelled && !(input.classified_share >= config_.least_classified_share)) {
    found.push_back(
        {Cause::nothing_classified, SafetyAction::none,
         core::text("segmentation gives {:.1f} % of the points a class, expected {:g} %",
                    100 * input.classified_share, 100 * config_.least_classified_share)});
  }
  return found;
}

/// Again with each block.
void Supervisor::look_up_from(const SupervisorInput& input) {
  if (input.grid == nullptr || input.grid->stamp == looked_at_) return;
  looked_at_ = input.grid->stamp;
  column_ = look_up(*input.grid, input.odometry.T_odom_body.translation(), config_.column_radius_m,
                    config_.height_m + config_.column_radius_m);
}

/// What stands there counts, whatever is said of it; what was not seen where nothing is said.
void Supervisor::find_column(std::vector<Finding>& found) const {
  if (column_.blocked()) {
    found.push_back({Cause::column_not_free, SafetyAction::none,
                     core::text("something is {:.1f} m over the vehicle, which climbs to {:g} m",
                                column_.lowest_m, config_.height_m)});
  } else if (!config_.column_free && !(1 - column_.unknown_share() >= config_.column_seen_share)) {
    found.push_back({Cause::column_not_free, SafetyAction::none,
                     core::text("{:.0f} % of the column over the vehicle was not seen: who sees "
                                "that it is free says so by mission.column_free",
                                100 * column_.unknown_share())});
  }
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
  mission.orders = std::move(input.orders);
  mission.safety = safety_.update(seen);
  if (mission_.phase() == MissionPhase::preflight) {
    look_up_from(input);
    mission.findings = on_the_ground(input, seen);
  } else if (mission_.taken_over()) {
    mission.findings = safety_.findings(seen);
  }
  Mission::Output output = mission_.step(mission);
  if (output.orders.planning == PlanningOrder::none) {
    // While it holds, an answer is still due: a hold for planning that hangs ends in a landing.
    if (mission_.phase() != MissionPhase::hold) planning_since_ = 0;
  } else if (planning_since_ == 0) {
    planning_since_ = input.now;
  }
  return output;
}

}  // namespace saker::autonomy
