#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "saker/active/config.h"
#include "saker/active/discovery/discovery.h"
#include "saker/active/discovery/sweep.h"
#include "saker/active/plan.h"
#include "saker/active/tour/target_tour.h"
#include "saker/active/tour/targets.h"
#include "saker/active/tour/vehicle_track.h"
#include "saker/core/budget.h"
#include "saker/motion/geofence.h"
#include "saker/motion/limits.h"
#include "saker/objects/object_map.h"
#include "saker/uncertainty/uncertainty.h"

/// Stage 6: where to fly next — reads the object map (from `slam`), the occupancy block (from the
/// collision checker) and the vehicle's pose at 1 Hz, makes the viewpoint to fly to (for `motion`
/// and the mission).
///
/// Frames: prior map, object map, viewpoints and geofence are in `world`, the block is in `odom`.
/// Method: the paper, "PAMS": a tour over the prior map's targets (`TargetTour`); which view of a
/// target is next is the policy's (`ViewChooser`: the paper's baseline or PAMS); discovery adds
/// targets that the prior map lacks and dismisses those that are not there; a sweep of the geofence
/// follows where so configured. Cost: a few milliseconds a decision, a tour of 1,000 targets about
/// a second.
namespace saker::active {

/// One object a mission; a function of the calls so far. Every flight ends: targets have a ceiling,
/// and each target and each stop of the sweep is given up in time (`TargetState`).
class Active {
 public:
  /// Throws Error on an invalid configuration or prior map, on a geofence that is to be swept and
  /// is too large; for policies `paper` and `saker` also without a model, or with one that lacks a
  /// target class.
  /// \param model  what views are worth; may be null for policy `visit`.
  /// \param limits  from which flight times follow.
  Active(const ActiveConfig& config, const objects::ClassTable& table,
         const objects::ObjectMap& prior, const motion::Geofence& fence,
         std::shared_ptr<const uncertainty::Model> model = nullptr,
         const motion::LimitsConfig& limits = {});

  /// At 1 Hz throughout the tour, also under way: what comes into view counts.
  [[nodiscard]] ActivePlan plan(const ActiveInput& input, const core::Budget& budget);

  /// Motion planning found no way to this viewpoint: it is not offered again.
  void refuse(int viewpoint_id, const std::string& reason);

  [[nodiscard]] const std::vector<Target>& targets() const { return tour_.targets(); }

  /// Whether there is nothing to fly for, from the beginning.
  [[nodiscard]] bool idle() const { return targets().empty() && !sweep_; }

 private:
  TargetTour tour_;
  Discovery discovery_;
  std::optional<Sweep> sweep_;
  VehicleTrack vehicle_;
};

/// The tour alone, with the configured policy, without discovery and sweep. Throws as `Active`.
[[nodiscard]] TargetTour make_tour(const ActiveConfig& config, const objects::ClassTable& table,
                                   const objects::ObjectMap& prior, InGeofence in_geofence,
                                   std::shared_ptr<const uncertainty::Model> model = nullptr,
                                   const motion::LimitsConfig& limits = {});

}  // namespace saker::active
