#pragma once

#include "saker/slam/landmark.h"

/// What speaks for a landmark, for those that ask whether it is one yet.
namespace saker::slam {

/// Log-odds of an object against clutter: windows that measured it and windows that missed it.
[[nodiscard]] inline double log_odds(const Landmark& landmark, const LandmarkConfig& config) {
  return landmark.log_odds - config.missed_log_odds * landmark.missed;
}

/// Whether it moves, or did in most of its windows: then it is no object of the map.
[[nodiscard]] inline bool is_mobile(const Landmark& landmark) {
  return landmark.moving || 2 * landmark.seen_moving > landmark.seen;
}

}  // namespace saker::slam
