#pragma once

#include "saker/objects/object_map.h"

namespace saker::objects::made {

/// The largest differences between two maps: m and rad.
struct MapError {
  double position = 0;  ///< distance in space
  double size = 0;      ///< of length, width or height
  double radius = 0, heading = 0, tilt = 0, probability = 0;
};

/// Objects of both are paired by their places. An object that has no other of its class within 1 m
/// makes all of it infinite.
[[nodiscard]] MapError largest_error(const ObjectMap& a, const ObjectMap& b);

}  // namespace saker::objects::made
