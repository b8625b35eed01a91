#pragma once

#include <vector>

#include "saker/objects/comparison.h"

/// Whether a map knows how good it is: the error of each found object in units of what its
/// covariance says (normalised estimation error squared, NEES; Bar-Shalom, Li, Kirubarajan,
/// "Estimation with Applications to Tracking and Navigation", 5.4).
namespace saker::objects {

/// NEES by its degrees of freedom: 1 on average where covariances are honest, more where they are
/// too sure. NaN where the map has no covariance.
struct ObjectConsistency {
  FoundPair ids;
  ClassId class_id = 0;
  double size = NAN;   ///< cuboid: length and width, 2 degrees of freedom; cylinder: radius, 1
  double place = NAN;  ///< x and y, 2 degrees of freedom
};

/// One entry for each pair of `compared`, in its order. Both maps are in the same frame, in which
/// drift is an error as any other: SLAM's covariances hold it.
[[nodiscard]] std::vector<ObjectConsistency> consistency(
    const ObjectMap& mapped, const ObjectMap& truth, const std::vector<ClassComparison>& compared);

/// NEES over objects; NaN of none.
struct ConsistencyFigures {
  int objects = 0;                 ///< that have a covariance
  double size = NAN, place = NAN;  ///< means
};

/// Over the objects of one class.
[[nodiscard]] ConsistencyFigures mean_consistency(const std::vector<ObjectConsistency>& objects,
                                                  ClassId class_id);

}  // namespace saker::objects
