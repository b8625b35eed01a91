#pragma once

#include <vector>

#include "objects/comparison.h"

/// Whether a map knows how good it is: the error of each found object in units of what its
/// covariance says (normalised estimation error squared, NEES; Bar-Shalom, Li, Kirubarajan,
/// "Estimation with Applications to Tracking and Navigation", 5.4).
namespace saker::objects {

struct ConsistencyOptions {
  double neighbourhood_m = 50;  ///< in x-y, from an object to those that its place is relative to
};

/// NEES by its degrees of freedom: 1 on average where covariances are honest, more where they are
/// too sure. NaN where the map has no covariance.
struct ObjectConsistency {
  FoundPair ids;
  ClassId class_id = 0;
  double size = NAN;   ///< cuboid: length and width, 2 degrees of freedom; cylinder: radius, 1
  double place = NAN;  ///< x and y relative to its neighbours, 2 degrees of freedom
};

/// One entry for each pair of `compared`, in its order.
///
/// Sizes do not depend on a frame. Places do: the map's covariance holds in SLAM's `world`, which
/// is the first keyframe's, and that frame is not the truth's (the first pose is levelled by an
/// accelerometer, drift bends the map). So an object's place is judged relative to its neighbours:
/// the planar motion (turn and shift) that brings the other objects within `neighbourhood_m`
/// nearest to the truth, by least squares with their covariances, is taken off its error, and the
/// motion's own covariance is added to the object's. NaN with fewer than two neighbours.
[[nodiscard]] std::vector<ObjectConsistency> consistency(
    const ObjectMap& mapped, const ObjectMap& truth, const std::vector<ClassComparison>& compared,
    const ConsistencyOptions& options = {});

/// NEES over objects; NaN of none.
struct ConsistencyFigures {
  int size_objects = 0, place_objects = 0;
  double size = NAN, place = NAN;  ///< means
};

/// Over the objects of one class.
[[nodiscard]] ConsistencyFigures mean_consistency(const std::vector<ObjectConsistency>& objects,
                                                  ClassId class_id);

}  // namespace saker::objects
