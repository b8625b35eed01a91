#pragma once

#include <Eigen/Core>

#include "motion/limits.h"

namespace saker::active {

/// Seconds to rest along a straight line and through a turn, as `motion` times its
/// trajectories: speed, climb and turn each with a trapezoid (or triangle) of its limits, the
/// slowest counts, and the window that smooths it. A way in two parts takes no less.
/// \param way m; \param turn rad; \param velocity m/s at the start: that across the way is brought
/// to rest beside it.
[[nodiscard]] double flight_time_s(const Eigen::Vector3d& way, double turn,
                                   const motion::LimitsConfig& limits,
                                   const Eigen::Vector3d& velocity = Eigen::Vector3d::Zero());

}  // namespace saker::active
