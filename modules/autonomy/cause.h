#pragma once

/// Why something happened: the codes that MISSION and HEALTH carry beside a text.
namespace saker::autonomy {

enum class Cause {
  none,
  // What is missing or has gone stale; before the flight it refuses, in flight it holds or lands.
  vehicle_silent,      ///< no state from the flight controller
  lidar_silent,        ///< no whole scan
  odometry_stale,      ///< no scan could be registered lately
  odometry_lost,       ///< for so long that the pose is a guess
  checker_silent,      ///< no verdict
  occupancy_stale,     ///< no occupancy block
  mapping_stale,       ///< no map from SLAM
  planning_stale,      ///< no answer from planning
  guidance_silent,     ///< guidance does not run
  outside_geofence,    ///< take-off place or vehicle
  battery_low,         ///< enough for the way back
  battery_empty,       ///< enough to land
  no_targets,          ///< no prior map, or no target in it
  nothing_classified,  ///< segmentation works, but gives next to no point a class
  collision,           ///< a contact was felt
  vehicle_descends,    ///< the flight controller trusts no odometry and comes down by itself
  off_course,          ///< the vehicle does not follow its setpoints
  stopped,             ///< guidance stops on the way: the verdict, or there is none
  // Waits that ended badly.
  preflight_deadline,
  command_refused,
  command_deadline,
  takeoff_deadline,
  tour_deadline,
  return_deadline,
  landing_deadline,
  hold_deadline,
  too_many_holds,
  // Planning.
  nothing_reachable,
  home_unreachable,
  // As it should be.
  ready,
  armed,
  took_off,
  tour_complete,
  home_reached,
  landed,
  recovered,
  ordered,  ///< by the operator, or a signal
  // Others than the executive.
  order_refused,    ///< what an operator ordered may not be now
  taken_over,       ///< a pilot, or a failsafe of the autopilot, flies
  battery_unknown,  ///< the flight controller does not say how much charge is left
  takeoff_blocked,  ///< the column above is not free, or not known to be
  place_unfit,      ///< nothing to land on, by what was seen of the ground
};

inline constexpr Cause kLastCause = Cause::place_unfit;  ///< codes have no gap up to it

/// One word, as MISSION shows it.
[[nodiscard]] const char* to_string(Cause cause);

}  // namespace saker::autonomy
