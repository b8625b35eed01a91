#pragma once

#include <array>

#include "saker/core/config.h"
#include "saker/motion/trajectory.h"

/// Coming to rest along a trajectory — reads the trajectory that is flown, makes the one that
/// brakes on it (for guidance).
///
/// The path is the trajectory's own, so that it leads only through what was checked; the speed
/// along it falls with bounded deceleration and jerk from the trajectory's speed and acceleration:
/// neither position nor velocity nor acceleration jumps, at the begin or at the end. Three phases
/// of constant jerk: Biagiotti & Melchiorri, "Trajectory Planning for Automatic Machines and
/// Robots", 2008, sec. 3.4, with the end speed 0. Cost: some 50 µs.
namespace saker::motion {

struct BrakingConfig {
  double deceleration_mps2 = 2.4;
  double jerk_mps3 = 12;
  double yaw_deceleration_deg = 180;
  double step_s = 0.05;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("deceleration_mps2", deceleration_mps2, {0.5, 20}, "m/s²",
            "along the trajectory: at most 1.2 of what plans ask for, so that one may begin in it");
    v.field("jerk_mps3", jerk_mps3, {1, 200}, "m/s³",
            "along the trajectory: from cruise to full braking in 0.2 s, while the body tilts");
    v.field("yaw_deceleration_deg", yaw_deceleration_deg, {1, 3600}, "°/s²",
            "of the turn, which ends by itself");
    v.field("step_s", step_s, {0.01, 0.2}, "s", "between states");
  }
};

/// Speed along a path, from now to rest.
class StopProfile {
 public:
  struct State {
    double distance_m = 0;
    double speed = 0;         ///< m/s, not negative
    double acceleration = 0;  ///< m/s², along the path
  };

  /// \param speed         now, m/s; not negative
  /// \param acceleration  now, m/s²; who brakes harder than `deceleration_mps2` goes on so
  StopProfile(double speed, double acceleration, const BrakingConfig& config);

  [[nodiscard]] double duration_s() const { return duration_s_; }
  [[nodiscard]] State at(double t) const;  ///< at rest from `duration_s` on

 private:
  struct Phase {
    double duration_s = 0;
    double jerk = 0;  // m/s³
  };

  std::array<Phase, 3> phases_;
  State begin_;
  double duration_s_ = 0;
};

/// The trajectory from `now` on, braked along itself until it stands.
/// \param memory  for its states: where it has room for them, nothing is allocated
[[nodiscard]] Trajectory braked(const Trajectory& trajectory, Time now, const BrakingConfig& config,
                                std::vector<MotionState> memory = {});

/// How far a stop that begins `now` would get: the trajectory's own time at its place of rest.
[[nodiscard]] Time stands_at(const Trajectory& trajectory, Time now, const BrakingConfig& config);

}  // namespace saker::motion
