#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "saker/active/tour/targets.h"
#include "saker/active/views/viewpoint.h"

namespace saker::active {

/// The viewpoints from which one target may be seen.
///
/// Reads a target's extent and the occupancy block, makes candidates in `world`, each with the
/// first reason that speaks against it. A function of its arguments. Method: rings around the
/// target (viewpoint.h). Cost: bearings · rings · five rays through the block.
class ViewpointSampler {
 public:
  ViewpointSampler(const ViewpointConfig& config, const FieldOfViewConfig& view,
                   InGeofence in_geofence);

  /// Directions × rings; the same direction and ring of a target have the same id.
  /// \param index  of the target in its list
  [[nodiscard]] std::vector<ViewpointCandidate> around(const Target& target, int index,
                                                       const OccupancyView& block) const;

  /// The viewpoint that is flown to stays where it is while it is good, with half of the margin:
  /// estimates tremble, and a goal that does, too, is never reached.
  [[nodiscard]] ViewpointCandidate goal(const Viewpoint& goal, const Target& target,
                                        const OccupancyView& block) const;

  /// Whether all of the target is in the field of view, and enough of it is hidden by nothing.
  [[nodiscard]] bool sees(const Eigen::Vector3d& eye, double yaw, const Target& target,
                          const OccupancyView& block, double margin_deg) const;

  [[nodiscard]] const ViewpointConfig& config() const { return config_; }
  [[nodiscard]] const FieldOfViewConfig& view() const { return view_; }
  [[nodiscard]] const InGeofence& in_geofence() const { return in_geofence_; }

 private:
  ViewpointConfig config_;
  FieldOfViewConfig view_;
  InGeofence in_geofence_;
};

/// Why none of the candidates is flown to: "no viewpoint left: 40 occupied, 12 hidden".
[[nodiscard]] std::string count_refusals(const std::vector<ViewpointCandidate>& candidates);

}  // namespace saker::active
