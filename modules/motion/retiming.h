#pragma once

#include <optional>
#include <vector>

#include "saker/motion/curve.h"
#include "saker/motion/limits.h"
#include "saker/motion/trajectory.h"

namespace saker::motion {

/// A curve with its speeds becomes a trajectory with bounded jerk: position over time is averaged
/// over a window of `limits.smoothing_s()`. A mean of velocities (accelerations) within a limit is
/// within it, and the path moves by no more than acceleration · window² / 24 (1.3 cm). The motion
/// that is averaged goes through the first window with the start's acceleration, so that the mean
/// begins with exactly the start's position, velocity and acceleration.

/// Where that first half window ends: from here the curve begins, in this direction at this speed.
[[nodiscard]] MotionState after_first_window(const MotionState& start, const LimitsConfig& limits);

/// \param curve   begins at `after_first_window(start)`
/// \param speeds  m/s, one a point, the last one zero; no two neighbours both zero
/// \return at rest at its end; its id is 0
[[nodiscard]] Trajectory retimed(const MotionState& start, Time start_time, const Curve& curve,
                                 const std::vector<double>& speeds, std::optional<double> goal_yaw,
                                 const LimitsConfig& limits);

}  // namespace saker::motion
