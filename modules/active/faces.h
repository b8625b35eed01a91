#pragma once

#include <Eigen/Core>

#include "active/belief.h"
#include "core/config.h"

namespace saker::active {

struct FacesConfig {
  double hidden_m = 0;
  double hidden_side_m = 0;
  double outside_m = 1;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field(
        "hidden_m", hidden_m, {0, 10}, "m",
        "sd that a face has beside the fitted one where a view does not look at it: what its upper "
        "edge does not tell; 0: as if all views measured all faces");
    v.field("hidden_side_m", hidden_side_m, {0, 10}, "m",
            "and the far side, seen squarely from beside; less by the square of the sine of the "
            "bearing towards the ends, where the upper edges of both sides are in view");
    v.field("outside_m", outside_m, {0.01, 20}, "m",
            "that the sensor is outside of a face's plane: it looks at the face");
  }
};

/// What a view tells of a box, face by face: each face that the eye looks at as well as the fitted
/// model says of where it is, the others only as well as their upper edges do, and in those windows
/// alone that show the box from end to end. Views from one side, however many, do not tell where
/// the other one is.
/// \param covariance  of [x, y, length, width], m²: of a window that shows both ends
/// \param whole       share of such windows
/// \param eye         in the box's frame, m
/// \param size        length and width, m
[[nodiscard]] Covariance by_faces(const Covariance& covariance, double whole,
                                  const Eigen::Vector2d& eye, const Eigen::Vector2d& size,
                                  const FacesConfig& config);

}  // namespace saker::active
