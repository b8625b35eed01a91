#pragma once

#include <cmath>

#include "saker/objects/measurement.h"
#include "saker/objects/models.h"

namespace saker::objects {

/// The axis of the longer horizontal edge, 0: x, 1: y.
[[nodiscard]] inline int longer_axis(const Cuboid& cuboid) {
  return cuboid.size.x() >= cuboid.size.y() ? 0 : 1;
}

/// m, of a measured cuboid's longer edge by its own points: whether both its ends were seen.
[[nodiscard]] inline double length_sd(const Measurement& measured) {
  if (std::isfinite(measured.length_sd)) return measured.length_sd;
  const int row = 6 + longer_axis(std::get<Cuboid>(measured.model));
  return std::sqrt(measured.covariance(row, row));
}

/// m, of its shorter edge: whether both its sides were seen.
[[nodiscard]] inline double width_sd(const Measurement& measured) {
  const int row = 7 - longer_axis(std::get<Cuboid>(measured.model));
  return std::sqrt(measured.covariance(row, row));
}

}  // namespace saker::objects
