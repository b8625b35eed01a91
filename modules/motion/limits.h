#pragma once

#include "saker/core/config.h"

namespace saker::motion {

/// What a trajectory may ask of the vehicle; every state of every trajectory keeps to it.
struct LimitsConfig {
  double max_speed = 2.5;
  double max_climb_speed = 1.0;
  double max_acceleration = 2.0;
  double max_jerk = 10;
  double max_yaw_rate_deg = 60;
  double max_yaw_acceleration_deg = 180;
  double step_s = 0.05;

  template <class Visitor>
  void visit(Visitor& v) {
    v.setting("max_speed", max_speed, {0.1, 20}, "m/s",
              "No trajectory is faster; a stop from it fits well inside what the sensor sees.");
    v.setting("max_climb_speed", max_climb_speed, {0.1, 10}, "m/s",
              "No trajectory climbs or descends faster: a rotor must not meet its own wake.");
    v.setting("max_acceleration", max_acceleration, {0.2, 20}, "m/s²",
              "No trajectory accelerates more; 2 m/s² tilt the body by 12°.");
    v.setting("max_jerk", max_jerk, {1, 200}, "m/s³",
              "No trajectory changes its acceleration, and so the body's tilt, faster.");
    v.setting("max_yaw_rate_deg", max_yaw_rate_deg, {1, 360}, "°/s",
              "No trajectory turns faster: scans must still be registered.");
    v.setting("max_yaw_acceleration_deg", max_yaw_acceleration_deg, {1, 3600}, "°/s²",
              "No trajectory speeds its turn up more: only the rotors' drag turns the body.");
    v.field("step_s", step_s, {0.01, 0.2}, "s",
            "between states of a trajectory: between them a cubic errs by less than 1 mm");
  }

  /// Window over which a profile of bounded acceleration is averaged to bound its jerk: a mean over
  /// T of accelerations within ±a changes by at most 2a/T.
  [[nodiscard]] double smoothing_s() const { return 2 * max_acceleration / max_jerk; }
};

}  // namespace saker::motion
