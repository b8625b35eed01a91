#pragma once

#include <optional>
#include <span>
#include <vector>

#include "saker/autonomy/battery_watch.h"
#include "saker/autonomy/cause.h"
#include "saker/autonomy/contact_sense.h"
#include "saker/core/config.h"
#include "saker/core/text.h"
#include "saker/core/vehicle.h"
#include "saker/motion/geofence.h"

/// The safety ladder, 50 Hz — reads ages, odometry and the vehicle's state, makes the most severe
/// action that they call for, with its cause (for the mission).
///
/// Rungs, mildest first: nothing; return (battery low or not known); hold (something is stale,
/// outside the geofence, off course); land (what was held for did not come back, battery empty,
/// collision); silence (odometry lost: a setpoint would be a guess, the flight controller descends
/// on IMU and barometer). A hold ends when its causes have been gone for `recover_s`. Reads no
/// clock; cost: a few comparisons, and in `update` no memory.
///
/// What is not known is never fine. A stamp that never came is older than any limit. A charge that
/// is not said keeps the vehicle on the ground; in flight it falls by the drain measured, and after
/// `battery_unknown_s` the vehicle returns. A place that is not a number is outside the geofence,
/// off course, and no way home from it is known. A pose without status is lost. Only a contact has
/// to be felt.
namespace saker::autonomy {

/// Stamps of the newest of everything that must not stop; 0: never came.
struct Heard {
  Time vehicle = 0;    ///< state of the flight controller
  Time lidar = 0;      ///< whole scan
  Time odometry = 0;   ///< scan that was registered
  Time verdict = 0;    ///< of the collision checker
  Time occupancy = 0;  ///< block
  Time mapping = 0;    ///< cycle of SLAM
  Time planning = 0;   ///< answer
  Time guidance = 0;   ///< run of guidance that ended
};

struct SafetyConfig {
  double vehicle_s = 0.5;
  double lidar_s = 0.5;
  double odometry_s = 0.5;
  double odometry_lost_s = 1.0;
  double verdict_s = 0.5;
  double occupancy_s = 2.0;
  double mapping_s = 5.0;
  double planning_s = 4.0;
  double land_after_s = 10.0;
  double recover_s = 3.0;
  double battery_return_share = 0.3;
  double battery_land_share = 0.15;
  double battery_flight_s = 900;
  double battery_unknown_s = 5;
  double way_home_mps = 1.0;
  double off_course_m = 1.5;

  template <class Visitor>
  void visit(Visitor& v) {
    v.setting("vehicle_s", vehicle_s, {0.05, 10}, "s",
              "The vehicle's state (50 Hz) may be silent for so long.");
    v.setting("lidar_s", lidar_s, {0.15, 10}, "s", "The lidar (10 Hz) may be silent for so long.");
    v.setting("odometry_s", odometry_s, {0.15, 10}, "s",
              "After so long without a registered scan, or with a pose so old, the vehicle holds.");
    v.setting("odometry_lost_s", odometry_lost_s, {0.2, 10}, "s",
              "After so long without a registered scan no setpoint is sent, unless the inertial "
              "unit knows the place.");
    v.setting("verdict_s", verdict_s, {0.15, 10}, "s",
              "The collision checker's verdict (10 Hz) may be silent for so long.");
    v.setting("occupancy_s", occupancy_s, {0.6, 30}, "s",
              "Its block of occupancy (2 Hz) may be silent for so long.");
    v.setting("mapping_s", mapping_s, {0.6, 60}, "s", "The map (2 Hz) may be silent for so long.");
    v.setting("planning_s", planning_s, {1.5, 60}, "s",
              "Planning (1 Hz) may be silent for so long.");
    v.setting("land_after_s", land_after_s, {0, 300}, "s",
              "A vehicle that holds lands after so long.");
    v.setting("recover_s", recover_s, {0.1, 60}, "s",
              "A vehicle that holds goes on after so long without a cause.");
    v.setting("battery_return_share", battery_return_share, {0, 1}, "",
              "It returns at this share of the charge.");
    v.setting("battery_land_share", battery_land_share, {0, 1}, "",
              "It lands where it is at this share of the charge, the reserve of the way home.");
    v.setting("battery_flight_s", battery_flight_s, {60, 36000}, "s",
              "A full battery lasts so long: what is believed before the drain is measured.");
    v.setting("battery_unknown_s", battery_unknown_s, {0.1, 60}, "s",
              "A charge may be unknown for so long in flight, then it returns.");
    v.setting("way_home_mps", way_home_mps, {0.1, 20}, "m/s",
              "The way home takes so long as its straight line at this speed.");
    v.setting(
        "off_course_m", off_course_m, {0.2, 20}, "m",
        "Farther than this from the setpoint, the vehicle cannot do what it is told and holds.");
  }
};

enum class SafetyAction { none, return_home, hold, land, silence };

[[nodiscard]] const char* to_string(SafetyAction action);

/// One thing that is wrong.
struct Finding {
  Cause cause = Cause::none;
  SafetyAction action = SafetyAction::none;  ///< what it calls for in flight
  core::Text text;                           ///< "no scan for 0.7 s, expected one every 0.5 s"
};

struct SafetyDecision {
  SafetyAction action = SafetyAction::none;
  Cause cause = Cause::none;
  core::Text text;
};

struct SafetyInput {
  Time now = 0;
  Heard heard;
  VehicleState vehicle;
  VehicleOdometry odometry;
  Contact contact;                   ///< the last one that was felt
  std::optional<Setpoint> setpoint;  ///< the one that is flown
  Eigen::Vector3d place =
      Eigen::Vector3d::Constant(NAN);  ///< `world`: what the geofence is to hold
  bool flying = false;                 ///< off the ground, by the mission's phase
  bool planning_due = false;           ///< planning has something to do
};

class Safety {
 public:
  Safety(const SafetyConfig& config, const motion::Geofence& geofence);  ///< throws Error

  /// Everything that is wrong now, without memory: what keeps a vehicle on the ground.
  [[nodiscard]] std::vector<Finding> findings(const SafetyInput& input) const;
  /// The same, added to `found`: allocates nothing where that has room.
  void find(const SafetyInput& input, std::vector<Finding>& found) const;

  /// In flight, at every step; on the ground it forgets.
  [[nodiscard]] SafetyDecision update(const SafetyInput& input);

 private:
  void find_silence(const SafetyInput& input, std::vector<Finding>& found) const;
  void find_vehicle(const SafetyInput& input, std::vector<Finding>& found) const;
  void find_battery(const SafetyInput& input, std::vector<Finding>& found) const;
  void find_contact(const SafetyInput& input, std::vector<Finding>& found) const;
  [[nodiscard]] double way_home_share(const SafetyInput& input) const;
  void find_place(const SafetyInput& input, std::vector<Finding>& found) const;
  [[nodiscard]] static SafetyDecision worst(std::span<const Finding> findings);

  SafetyConfig config_;
  motion::Geofence geofence_;
  BatteryWatch battery_;
  std::vector<Finding> found_;  // of this step; its memory is used again
  SafetyDecision held_for_;     // the hold under way
  Time held_since_ = 0;
  Time last_cause_ = 0;  // when the hold's causes were last there
};

}  // namespace saker::autonomy
