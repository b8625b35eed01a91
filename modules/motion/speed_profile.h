#pragma once

#include <optional>
#include <vector>

#include "saker/motion/curve.h"
#include "saker/motion/limits.h"

namespace saker::motion {

/// The greatest speed at each point of a curve, at rest at its end, so that speed, climb and
/// acceleration along and across it together stay within the limits: one pass backward, one forward
/// (Bobrow, Dubowsky & Gibson, IJRR 1985, for a point mass). Cost: linear.
/// \param start_speed  m/s, kept at the first point
/// \return m/s; none when the vehicle cannot slow down from `start_speed` in time
[[nodiscard]] std::optional<std::vector<double>> speed_profile(const Curve& curve,
                                                               double start_speed,
                                                               const LimitsConfig& limits);

}  // namespace saker::motion
