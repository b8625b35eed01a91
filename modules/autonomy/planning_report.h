#pragma once

#include <cstdint>

#include "saker/autonomy/landing_place.h"
#include "saker/autonomy/takeoff_column.h"
#include "saker/core/text.h"
#include "saker/core/time.h"

namespace saker::autonomy {

/// What the mission asks planning for.
enum class PlanningOrder {
  none,  ///< nothing: on the ground, hold, landing
  tour,  ///< to the next viewpoint of the policy
  home,  ///< to above the place of take-off
  land   ///< to above the nearest place that is fit to land on
};

[[nodiscard]] inline const char* to_string(PlanningOrder order) {
  constexpr const char* kNames[] = {"none", "tour", "home", "land"};
  return kNames[static_cast<int>(order)];
}

enum class PlanningStatus {
  idle,               ///< nothing was asked for
  flying,             ///< what is committed leads to the goal, or a proposal was made
  refused,            ///< no way this time; `text` says why
  gave_up,            ///< on one goal after too many refusals; there are others
  tour_complete,      ///< no target is left: all visited, or some unreachable, or none was found
  nothing_reachable,  ///< no target is left, and of those that there are none was visited
  home_reached,
  home_unreachable,  ///< too many refusals on the way home
  no_place,          ///< nothing within reach is fit to land on
};

[[nodiscard]] inline const char* to_string(PlanningStatus status) {
  constexpr const char* kNames[] = {"idle",         "flying",           "refused",
                                    "gave up",      "tour complete",    "nothing reachable",
                                    "home reached", "home unreachable", "no place"};
  return kNames[static_cast<int>(status)];
}

/// What became of one step of planning, for the mission and PLAN.
struct PlanningReport {
  Time stamp = 0;  ///< 0: there has been none
  PlanningOrder order = PlanningOrder::none;
  PlanningStatus status = PlanningStatus::idle;
  core::Text text;
  int target = -1;  ///< id of the target under way; −1: none
  int targets = 0;  ///< in all
  int visited = 0;
  int unreachable = 0;
  int refusals = 0;      ///< in a row, at this goal
  TakeoffColumn column;  ///< over the vehicle, where nothing is ordered
  LandingPlace landing;  ///< below the vehicle, but on the tour
};

}  // namespace saker::autonomy
