#pragma once

#include <optional>

#include "saker/active/config.h"
#include "saker/active/discovery/coverage.h"
#include "saker/active/tour/target_state.h"
#include "saker/active/tour/vehicle_track.h"
#include "saker/active/views/viewpoint.h"
#include "saker/motion/geofence.h"
#include "saker/objects/object_map.h"

namespace saker::active {

/// The sweep of a geofence for targets, back and forth, when no known target is pending.
///
/// Reads pose, occupancy block and map, makes the stop to fly to. A stop is closed for good once
/// the vehicle was there for long enough, makes no progress, or motion planning refuses it: a sweep
/// ends. Frames: stops are in `world`. Cost: linear in the squares of the geofence (coverage.h).
class Sweep {
 public:
  /// Throws Error where the geofence is too large.
  Sweep(const ActiveConfig& config, const motion::Geofence& fence);

  /// What was in view since the last decision.
  void observe(const VehicleTrack& vehicle, const OccupancyView& block,
               const objects::ObjectMap* map);

  /// The viewpoint to fly to; none: the geofence is covered.
  [[nodiscard]] std::optional<Viewpoint> next(const VehicleTrack& vehicle,
                                              const OccupancyView& block,
                                              const objects::ObjectMap* map);

  /// A target is flown to instead: the stop stays due, and begins anew.
  void leave() { stop_.reset(); }

  /// \return whether the viewpoint is the sweep's: its stop is closed then.
  [[nodiscard]] bool refuse(int viewpoint_id);

  [[nodiscard]] double seen_share() const { return coverage_.seen_share(); }  ///< of the geofence

 private:
  struct Stop {
    std::size_t number;
    Viewpoint viewpoint;
    TargetState state;
  };

  void close_stop();
  [[nodiscard]] Viewpoint viewpoint_at(std::size_t number, const VehicleTrack& vehicle,
                                       const objects::ObjectMap* map) const;
  [[nodiscard]] bool flyable(const Viewpoint& viewpoint, const OccupancyView& block) const;

  ActiveConfig config_;
  GoalLimits limits_;
  motion::Geofence fence_;
  Coverage coverage_;
  std::optional<Stop> stop_;  ///< that is flown to
};

}  // namespace saker::active
