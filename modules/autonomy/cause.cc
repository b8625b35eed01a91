#include "saker/autonomy/cause.h"

#include <iterator>

namespace saker::autonomy {

const char* to_string(Cause cause) {
  constexpr const char* kNames[] = {"none",
                                    "vehicle_silent",
                                    "lidar_silent",
                                    "odometry_stale",
                                    "odometry_lost",
                                    "checker_silent",
                                    "occupancy_stale",
                                    "mapping_stale",
                                    "planning_stale",
                                    "guidance_silent",
                                    "outside_geofence",
                                    "battery_low",
                                    "battery_empty",
                                    "no_targets",
                                    "nothing_classified",
                                    "collision",
                                    "vehicle_descends",
                                    "off_course",
                                    "stopped",
                                    "preflight_deadline",
                                    "command_refused",
                                    "command_deadline",
                                    "takeoff_deadline",
                                    "tour_deadline",
                                    "return_deadline",
                                    "landing_deadline",
                                    "hold_deadline",
                                    "too_many_holds",
                                    "nothing_reachable",
                                    "home_unreachable",
                                    "ready",
                                    "armed",
                                    "took_off",
                                    "tour_complete",
                                    "home_reached",
                                    "landed",
                                    "recovered",
                                    "ordered",
                                    "order_refused",
                                    "taken_over",
                                    "battery_unknown",
                                    "takeoff_blocked",
                                    "place_unfit"};
  static_assert(std::size(kNames) == static_cast<std::size_t>(kLastCause) + 1);
  return kNames[static_cast<int>(cause)];
}

}  // namespace saker::autonomy
