#pragma once

#include <optional>
#include <span>
#include <vector>

#include "saker/autonomy/mission.h"
#include "saker/autonomy/safety.h"

namespace saker::autonomy {

struct SupervisorInput {
  Time now = 0;
  Heard heard;
  VehicleState vehicle;
  VehicleOdometry odometry;
  SE3 T_world_odom = SE3::Identity();
  Contact contact;                   ///< the last one that was felt
  std::optional<Setpoint> setpoint;  ///< the one that is flown
  Acks acks;                         ///< since the last step
  PlanningReport planning;           ///< the newest
  GuidanceStop stop;                 ///< the last one
  bool has_targets = false;          ///< or a geofence to sweep for them
  double classified_share = NAN;     ///< of the newest labelled scan
  bool land_ordered = false;
  bool marked = true;         ///< a restart would know of this flight: else it does not arm
  std::vector<Order> orders;  ///< of an operator, since the last step; at any moment
};

/// One step of the safety loop: what the ladder says, and what the mission makes of it.
class Supervisor {
 public:
  Supervisor(const SafetyConfig& safety, const MissionConfig& mission,
             const motion::Geofence& geofence);  ///< throws Error on an invalid value

  [[nodiscard]] Mission::Output step(SupervisorInput input);

  [[nodiscard]] const Mission& mission() const { return mission_; }

 private:
  [[nodiscard]] SafetyInput safety_input(const SupervisorInput& input) const;
  [[nodiscard]] std::span<const Finding> on_the_ground(const SupervisorInput& input,
                                                       const SafetyInput& seen);

  double height_m_;
  double least_classified_share_;
  Safety safety_;
  std::vector<Finding> found_;  // of this step, for the mission; its memory is used again
  Mission mission_;
  Time planning_since_ = 0;  // when planning was last asked to begin; 0: it is not asked
};

}  // namespace saker::autonomy
