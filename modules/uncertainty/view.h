#pragma once

#include "saker/core/se3.h"
#include "saker/objects/models.h"

namespace saker::uncertainty {

/// From where an object is seen, relative to the object: what measurements depend on.
struct View {
  double range = NAN;      ///< m, in x-y from the lidar to the object's centre or root
  double angle = NAN;      ///< rad in (−π, π]: the lidar's bearing in the cuboid's frame, 0 in
                           ///< front of it, π/2 to its left, π behind; 0 for cylinders
  double elevation = NAN;  ///< rad, of the lidar over the object's middle
  double reflectivity = NAN;  ///< mean of the points', as the sensor says it; NaN: unknown
};

/// The view of `model` that a lidar at `eye` has, both in one frame with z up; its reflectivity is
/// unknown.
[[nodiscard]] View view_of(const Eigen::Vector3d& eye, const objects::Model& model);

}  // namespace saker::uncertainty
