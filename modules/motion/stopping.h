#pragma once

#include "motion/limits.h"
#include "motion/trajectory.h"

namespace saker::motion {

/// The quickest stop from any state within acceleration and jerk: the acceleration runs straight to
/// a constant one against the velocity, stays, and runs back to zero (a trapezoid, each ramp
/// `limits.smoothing_s()` long). It is not checked for collisions: stopping is the last resort.
/// \return from `time` on, continuous with `state` in position, velocity and acceleration; empty
///         when the state is not finite, or too wild to be one of the vehicle's.
[[nodiscard]] Trajectory stopping_trajectory(const MotionState& state, Time time,
                                             const LimitsConfig& limits);

}  // namespace saker::motion
