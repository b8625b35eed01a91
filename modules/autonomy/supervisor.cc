#include "saker/autonomy/supervisor.h"

#include <algorithm>
#include <utility>

namespace saker::autonomy {
namespace {

constexpr double kLooked_s = 4;            // planning looks up every second
constexpr std::size_t kMostFindings = 32;  // more than there are: room from the first step on

}  // namespace

Supervisor::Supervisor(const SafetyConfig& safety, const MissionConfig& mission,
                       const motion::Geofence& geofence)
    : height_m_(mission.height_m),
      least_classified_share_(mission.least_classified_share),
      safety_(safety, geofence),
      mission_(mission) {}

SafetyInput Supervisor::safety_input(const SupervisorInput& input) const {
  SafetyInput result;
  result.now = input.now;
  result.heard = input.heard;
  result.vehicle = input.vehicle;
  result.odometry = input.odometry;
  result.contact = input.contact;
  result.setpoint = input.setpoint;
  result.flying = mission_.flying() && !mission_.taken_over();
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

/// What keeps it there: the ladder's findings, and what only matters before the flight.
std::span<const Finding> Supervisor::on_the_ground(const SupervisorInput& input,
                                                   const SafetyInput& seen) {
  std::vector<Finding>& found = found_;
  safety_.find(seen, found);
  if ((input.vehicle.faults & kTakenOver) != 0) {
    found.push_back({Cause::taken_over, SafetyAction::none, "somebody else has it: resume"});
  }
  if (input.planning.column.blocked()) {
    found.push_back({Cause::takeoff_blocked, SafetyAction::none, input.planning.column.text()});
  }
  if (!input.has_targets) {
    found.push_back({Cause::no_targets, SafetyAction::none, "no target to map"});
  }
  const bool labelled = input.heard.mapping != 0;  // else the map is missing, which is said
  if (labelled && !(input.classified_share >= least_classified_share_)) {
    found.push_back(
        {Cause::nothing_classified, SafetyAction::none,
         core::text("segmentation gives {:.1f} % of the points a class, expected {:g} %",
                    100 * input.classified_share, 100 * least_classified_share_)});
  }
  return found;
}

Mission::Output Supervisor::step(SupervisorInput input) {
  const SafetyInput seen = safety_input(input);
  MissionInput mission;
  mission.now = input.now;
  mission.vehicle = input.vehicle;
  mission.odometry = input.odometry;
  mission.acks = std::move(input.acks);
  mission.looked_up = input.planning.column.state != TakeoffColumn::State::not_looked &&
                      input.now - input.planning.stamp <= from_seconds(kLooked_s);
  mission.stop = std::move(input.stop);
  mission.plant_heard = std::max(input.heard.vehicle, input.heard.lidar);
  mission.land_ordered = input.land_ordered;
  mission.marked = input.marked;
  mission.orders = std::move(input.orders);
  mission.safety = safety_.update(seen);
  found_.clear();
  found_.reserve(kMostFindings);
  if (mission_.phase() == MissionPhase::preflight) {
    mission.findings = on_the_ground(input, seen);
  } else if (mission_.taken_over()) {
    safety_.find(seen, found_);
    mission.findings = found_;
  }
  mission.planning = std::move(input.planning);  // its column was read
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
