#pragma once

#include <string>

#include "saker/motion/free_space.h"
#include "saker/motion/limits.h"
#include "saker/motion/trajectory.h"

namespace saker::motion {

struct TrajectoryCheck {
  std::string fault;         ///< one line: what is wrong, and where; empty: nothing
  double clearance_m = NAN;  ///< least distance to what is not free, up to the fault
};

/// A trajectory's last examination, independent of how it was made: safe at steps of at most 5 cm,
/// within the limits (or what its first state has beyond them), and at rest at its end.
[[nodiscard]] TrajectoryCheck examined(const Trajectory& trajectory, const FreeSpace& space,
                                       const LimitsConfig& limits);

}  // namespace saker::motion
