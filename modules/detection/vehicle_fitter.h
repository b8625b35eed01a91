#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "saker/detection/beams.h"
#include "saker/detection/surroundings.h"
#include "saker/objects/models.h"

/// The plan of a vehicle, its rectangle on the ground, from the points of one window.
///
/// Reads the places of its points on the ground plane, how high they reach and what the beams
/// around it did. Makes heading and faces with covariance. Frame: the local ground's (z = 0 the
/// ground). Two methods implement it: the paper's hull (hull_fitter.h) and the faces' densities
/// (face_fitter.h); `detection.vehicle.fitter` chooses.
namespace saker::detection {

/// From where a cluster was looked at, and what the beams around it met.
struct Sight {
  std::vector<Eigen::Vector3d> sensors;  ///< where the scans were taken, in the frame of the points
  const Beams& beams;
  const Surroundings& surroundings;
  SE3 T_level_local;  ///< from the frame of the points to that of the beams and the surroundings

  /// \param box in the frame of the points
  [[nodiscard]] int through(const objects::Cuboid& box, const objects::Cuboid& body) const {
    return beams.through(objects::transformed(T_level_local, box),
                         objects::transformed(T_level_local, body));
  }
  [[nodiscard]] int ended(const objects::Cuboid& box) const {
    return beams.ended(objects::transformed(T_level_local, box));
  }
  [[nodiscard]] double nearest(const objects::Cuboid& box, int count, double least_m,
                               const Bow& bow) const {
    return beams.nearest(objects::transformed(T_level_local, box), count, least_m, bow);
  }
  /// \return points of no object in the box, between the heights of `SurroundingsConfig`
  [[nodiscard]] int others(const objects::Cuboid& box) const {
    return surroundings.inside(objects::transformed(T_level_local, box));
  }
};

using Places = std::vector<Eigen::Vector2d>;

struct VehicleView {
  Places places;   ///< of its points, thinned evenly, at the time of the last scan
  int points = 0;  ///< before they were thinned
  double top = 0;  ///< m above the ground, of the highest points
  const Sight& sight;
};

/// Extent along one axis.
struct Extent {
  double low = 0;
  double high = 0;
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Constant(NAN);  ///< of [centre, size]

  [[nodiscard]] double centre() const { return 0.5 * (low + high); }
  [[nodiscard]] double size() const { return high - low; }
};

/// The covariance of [centre, size] by that of [low, high].
[[nodiscard]] inline Eigen::Matrix2d of_centre_and_size(const Eigen::Matrix2d& of_edges) {
  Eigen::Matrix2d to_centre_size;
  to_centre_size << 0.5, 0.5, -1, 1;
  return to_centre_size * of_edges * to_centre_size.transpose();
}

/// A rectangle.
struct Plan {
  double heading = 0;          ///< of the first axis, radians
  double heading_sd = 0;       ///< radians
  std::array<Extent, 2> axis;  ///< along the heading, across it (to the left)
  bool several = false;        ///< likelier more than one vehicle
};

class VehicleFitter {
 public:
  virtual ~VehicleFitter() = default;

  /// What the points alone show, the longer axis first; without covariances.
  /// \param view with three places and more
  [[nodiscard]] virtual Plan outline(const VehicleView& view) const = 0;

  /// The vehicle's rectangle, its length first.
  /// \param outline of that view
  [[nodiscard]] virtual Plan fit(const VehicleView& view, const Plan& outline) const = 0;
};

/// A box on the ground with its first two axes along a plan's.
/// \param plan low and high corner along these axes
/// \param height above the ground, lower and upper end
[[nodiscard]] objects::Cuboid upright(double direction, const std::array<Eigen::Vector2d, 2>& plan,
                                      const std::array<double, 2>& height);

/// Horizontal distance of the nearest sensor, m.
[[nodiscard]] double nearest_range(const Eigen::Vector2d& place, const Sight& sight);

}  // namespace saker::detection
