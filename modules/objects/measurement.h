#pragma once

#include <vector>

#include "saker/core/time.h"
#include "saker/objects/class_table.h"
#include "saker/objects/models.h"

namespace saker::objects {

/// One output of a virtual sensor: an object as seen from the robot at `stamp`.
struct Measurement {
  Time stamp = 0;                         ///< of the scan in whose lidar frame the model is given
  ClassId class_id = 0;                   ///< the most probable class
  std::vector<double> class_probability;  ///< one an entry of the class table, sums to 1
  Model model;                            ///< in the lidar frame at `stamp`
  Eigen::MatrixXd covariance;  ///< 9×9 [rotation, translation, size] in the cuboid's own frame, or
                               ///< 6×6 [root, axis in its tangent plane, radius] in the lidar frame
  double front_log_odds = 0;  ///< > 0: the model's x axis points to the front (cuboids)
  int points = 0;             ///< that the model was fitted to
  int view_cell = -1;         ///< of an interval of range and angle (view_cell.h), all of whose
                              ///< windows share their error and count once; −1: counts by itself
  double reflectivity = NAN;  ///< mean of those points', 0 … 1; NaN: the scans have none
  double length_sd = NAN;     ///< m, of a cuboid's longer edge by its own points, where
                              ///< `covariance` is a fitted one: whether both its ends were seen
  bool moving = false;        ///< seen to move within the window; kept out of the map
};

/// Where a covariance holds what an object covers of the ground: [x, y, length, width] of a cuboid,
/// [x, y] of a cylinder's root.
[[nodiscard]] inline std::vector<int> planar_rows(const Model& model) {
  if (std::holds_alternative<Cuboid>(model)) return {3, 4, 6, 7};
  return {0, 1};
}

/// Everything that was measured from one window of scans.
struct Detections {
  Time stamp = 0;
  std::vector<Measurement> measurements;
  std::vector<GroundPlane> ground;  ///< local ground planes, lidar frame at `stamp`
};

}  // namespace saker::objects
