#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <vector>

#include "saker/core/time.h"

namespace saker::motion {

/// Where the body should be at one moment, in the trajectory's frame.
struct MotionState {
  Eigen::Vector3d position = Eigen::Vector3d::Constant(NAN);      ///< m
  Eigen::Vector3d velocity = Eigen::Vector3d::Constant(NAN);      ///< m/s
  Eigen::Vector3d acceleration = Eigen::Vector3d::Constant(NAN);  ///< m/s²
  double yaw = NAN;                                               ///< rad
  double yaw_rate = NAN;                                          ///< rad/s
};

/// The same angle within ±π.
[[nodiscard]] double wrapped(double angle);

/// A timed motion in `odom` that ends at rest. Samples at a fixed step; between them cubic Hermite
/// interpolation of position and velocity. After its end it stays at its last state, at rest.
struct Trajectory {
  std::int64_t id = 0;  ///< ascending; 0: none
  Time start = 0;
  double step_s = NAN;
  std::vector<MotionState> states;  ///< at start, start + step, …

  [[nodiscard]] bool empty() const { return states.empty(); }
  [[nodiscard]] double duration_s() const {
    return empty() ? 0 : step_s * static_cast<double>(states.size() - 1);
  }
  [[nodiscard]] Time end() const { return start + from_seconds(duration_s()); }
  [[nodiscard]] MotionState sample(Time time) const;  ///< clamped to start … end
};

/// Why a trajectory may not be flown to its end.
enum class VerdictReason : std::uint8_t {
  none,           ///< it may
  occupied,       ///< it comes too near to something
  unknown,        ///< it enters what was never seen
  stale_scan,     ///< no scan was integrated for too long
  no_trajectory,  ///< none has come yet
};

[[nodiscard]] inline const char* to_string(VerdictReason reason) {
  constexpr const char* kNames[] = {"none", "occupied", "unknown", "stale_scan", "no_trajectory"};
  return kNames[static_cast<int>(reason)];
}

/// What the collision checker says of a trajectory, 10 Hz; silence means stop.
struct Verdict {
  Time stamp = 0;
  std::int64_t trajectory_id = 0;
  bool clear = false;                                          ///< all of it, from `stamp` on
  VerdictReason reason = VerdictReason::no_trajectory;         ///< of not being clear
  Time clear_until = 0;                                        ///< it may be flown up to here
  Eigen::Vector3d first_hit = Eigen::Vector3d::Constant(NAN);  ///< m, odom; NaN where clear
  double clearance_m = NAN;  ///< least distance from the body's centre to an occupied cell, at most
};

}  // namespace saker::motion
