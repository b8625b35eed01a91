#pragma once

#include <optional>

#include "mavlink/messages.h"
#include "tools/sim/mavlink/craft.h"
#include "tools/sim/mavlink/quirks.h"

/// Setpoints of the line → setpoints of the inner loops, with what each autopilot does when they
/// stop or are half there.
///
/// Reads SET_POSITION_TARGET_LOCAL_NED with the autopilot's time at which it came. Its target does
/// not move when odometry is reset: who does not shift it sees the jump flown back.
namespace saker::tools {

class Guided {
 public:
  /// \param quirks  have to outlive this
  explicit Guided(const Quirks& quirks) : quirks_(quirks) {}

  /// Stands there.
  void hold(const Eigen::Vector3d& position, double yaw);
  /// False where it is dropped.
  bool hear(const flight::mavlink::SetPositionTargetLocalNed& target, Time now);

  /// Whether setpoints come.
  [[nodiscard]] bool streamed(Time now) const;
  /// Since when; nothing where none come.
  [[nodiscard]] std::optional<Time> heard_at() const { return heard_at_; }
  /// Whether the last one asks for a climb above `height`.
  [[nodiscard]] bool wants_above(double height) const;

  /// For the inner loops, now.
  [[nodiscard]] Setpoint setpoint(const CraftState& craft, Time now);

 private:
  struct Target {
    std::optional<Eigen::Vector3d> position, velocity, acceleration;
    double yaw = NAN, yaw_rate = NAN;
  };

  [[nodiscard]] Eigen::Vector3d place(const CraftState& craft, double seconds);

  const Quirks& quirks_;
  Target target_;
  std::optional<Time> heard_at_;  // the last target that was not dropped
  bool stands_ = true;            // no setpoint of the line counts
};

}  // namespace saker::tools
