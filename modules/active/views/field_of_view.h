#pragma once

#include <Eigen/Core>

#include "saker/core/config.h"
#include "saker/objects/models.h"

/// What the lidar has between its beams, mounted level or tilted.
///
/// Reads a pose, a target and the field of view, answers whether all of it is in view. Exact for
/// upright cuboids: a cone's bulge into the box is found by golden sections. Cost: eight corners.
/// Frames: eyes and targets are in `world`, where the body hovers level with a heading; the lidar
/// is taken to be at the body's place, which `margin_deg` covers.
namespace saker::active {

struct FieldOfViewConfig {
  double margin_deg = 2;
  double nearest_m = 2;
  double farthest_m = 16;

  /// The lowest and the highest beam: no settings, the sensor's metadata says them. Without, an
  /// OS1 (second generation).
  double lowest_deg = -22.5;
  double highest_deg = 22.5;
  /// As the lidar is mounted: `mount` says it.
  Eigen::Matrix3d R_body_lidar = Eigen::Matrix3d::Identity();

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("margin_deg", margin_deg, {0, 20}, "deg",
            "kept of it when a viewpoint is chosen: pitch, and the lidar's place on the body");
    v.field("nearest_m", nearest_m, {0, 20}, "m", "in x-y to the target's nearest point");
    v.setting("farthest_m", farthest_m, {1, 100}, "m",
              "A target is looked at from no farther, in x-y: beams must not be too far apart.");
  }
};

/// Whether all of the target is between the beams and in the range, of a body at `eye` that heads
/// to `yaw`. Exact for an upright cuboid.
[[nodiscard]] bool in_field_of_view(const Eigen::Vector3d& eye, double yaw,
                                    const objects::Cuboid& target, const FieldOfViewConfig& config,
                                    double margin_deg);

/// Whether a point is between the beams, at any range.
[[nodiscard]] bool between_beams(const Eigen::Vector3d& eye, double yaw,
                                 const Eigen::Vector3d& point, const FieldOfViewConfig& config);

/// Where a level lidar sees all around, a tilted one has two directions at each elevation midway
/// between its beams, or one that comes nearest to that. \return rad, from the nose to the left: of
/// these the one that is nearest to the nose; level: 0.
[[nodiscard]] double viewing_azimuth(double elevation, const FieldOfViewConfig& config);

/// Whether it sees to where it flies, whatever its heading: level directions on all sides.
[[nodiscard]] bool sees_all_around(const FieldOfViewConfig& config);

/// The same for a body that flies nose first, as trajectories do.
[[nodiscard]] bool sees_ahead(const FieldOfViewConfig& config);

}  // namespace saker::active
