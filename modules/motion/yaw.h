#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "saker/motion/limits.h"

namespace saker::motion {

struct YawState {
  double yaw = NAN;       ///< rad, not wrapped
  double yaw_rate = NAN;  ///< rad/s
};

/// Yaw along a motion: looks where it goes, and turns to the goal's yaw so that both end together,
/// or the turn after the motion. Rate-limited steps averaged over a window: a mean of rates within
/// the limit is within it, and it changes by no more than the window allows.
/// \param velocities  m/s, every `step_s` from the start on
/// \param start  kept: no jump in yaw or rate
/// \return every `step_s`, at least as many as velocities; at rest at its end
[[nodiscard]] std::vector<YawState> yaw_along(const std::vector<Eigen::Vector3d>& velocities,
                                              double step_s, const YawState& start,
                                              std::optional<double> goal_yaw,
                                              const LimitsConfig& limits);

}  // namespace saker::motion
