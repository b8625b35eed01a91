#pragma once

#include <Eigen/Core>

#include "saker/motion/limits.h"

namespace saker::active {

/// Reads a straight way and the vehicle's limits, makes the time that it takes; no frame.
///
/// Seconds from rest to rest along a straight line and through a turn, as `motion` times its
/// trajectories: speed, climb and turn each with a trapezoid (or triangle) of its limits, the
/// slowest counts, and the window that smooths it. A way in two parts takes no less.
/// \param way m; \param turn rad.
[[nodiscard]] double flight_time_s(const Eigen::Vector3d& way, double turn,
                                   const motion::LimitsConfig& limits);

}  // namespace saker::active
