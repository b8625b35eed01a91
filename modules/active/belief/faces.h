#pragma once

#include <Eigen/Core>

#include "saker/active/belief/belief.h"
#include "saker/core/config.h"

/// What a view tells of each face of a box.
///
/// Reads the fitted covariance of a view and where the eye is, makes the view's measurement.
/// Frames: the box's own. Method: one row of information for each face. Cost: four rows of 4.
namespace saker::active {

struct FacesConfig {
  double hidden_end_m = 0;
  double hidden_side_m = 0;
  double outside_m = 1;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("hidden_end_m", hidden_end_m, {0, 10}, "m",
            "sd of an end that no view looks at: what its upper edge does not tell; 0: as if all "
            "views measured it");
    v.field("hidden_side_m", hidden_side_m, {0, 10}, "m",
            "the same of the far side, seen squarely from beside; less by the square of the sine "
            "of the bearing towards the ends, where the upper edges of both sides are in view");
    v.field("outside_m", outside_m, {0.01, 20}, "m",
            "that the sensor is outside of a face's plane: it looks at the face");
  }
};

/// How a view measures a box, face by face. A face that the eye sees is measured as well as the
/// fitted model says. The others are measured in those windows alone that show the box from end to
/// end, and only as well as their upper edges tell, which is the same in all views from one side.
/// \param covariance  of [x, y, length, width], m²: of a window that shows both ends
/// \param complete_share  of windows that show the box from end to end
/// \param eye         in the box's frame, m
/// \param size        length and width, m
[[nodiscard]] Measured by_faces(const Covariance& covariance, double complete_share,
                                const Eigen::Vector2d& eye, const Eigen::Vector2d& size,
                                const FacesConfig& config);

}  // namespace saker::active
