#pragma once

#include <vector>

#include "saker/motion/free_space.h"
#include "saker/motion/path.h"

namespace saker::motion {

/// A point of a curve of straight legs and arcs, at most 5 cm from the next one.
struct CurvePoint {
  double s = NAN;                                             ///< m, along the curve
  Eigen::Vector3d position = Eigen::Vector3d::Constant(NAN);  ///< m
  Eigen::Vector3d arriving = Eigen::Vector3d::Constant(NAN);  ///< unit, direction of travel
  Eigen::Vector3d leaving = Eigen::Vector3d::Constant(NAN);   ///< the same but at a sharp corner
  double curvature = 0;                                       ///< 1/m
  bool stop = false;                                          ///< a corner too sharp to fly through
};
using Curve = std::vector<CurvePoint>;

/// The path with its corners rounded by arcs, each as wide as `widest_m` and the legs allow (inner
/// legs are shared by halves) and halved until it is free; where none is, the corner stays and is
/// a stop. Corners under 3° stay too: the averaging of the speeds rounds them.
/// \param first_share  of its widest arc that the first corner gets
/// \return at least one point
[[nodiscard]] Curve rounded(const Waypoints& path, const FreeSpace& space, double widest_m,
                            double first_share);

}  // namespace saker::motion
