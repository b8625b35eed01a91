#pragma once

#include <vector>

#include "saker/core/time.h"
#include "saker/objects/class_table.h"
#include "saker/objects/models.h"

namespace saker::objects {

struct MapObject {
  int id = -1;
  ClassId class_id = 0;
  std::vector<double> class_probability;  ///< fused, one an entry of the class table
  int observations = 0;
  Model model;  ///< in the map's frame
  Eigen::MatrixXd
      covariance;   ///< as in Measurement, in the object's own frame; empty where not computed
  int points = -1;  ///< returns that hit it, said by a simulator's truth; −1: unknown
};

/// The sparse map: objects and local ground, in `frame`.
struct ObjectMap {
  std::string frame = "world";
  std::vector<MapObject> objects;  ///< ascending id
  std::vector<GroundPlane> ground;
  /// What stands there as well, but nobody has seen its ends: no part of what is told to others.
  std::vector<MapObject> incomplete = {};  ///< ascending id
};

}  // namespace saker::objects
