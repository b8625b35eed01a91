#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "saker/core/config.h"
#include "saker/core/text.h"
#include "saker/core/vehicle.h"
#include "saker/motion/braking.h"
#include "saker/motion/trajectory.h"

/// Guidance, 50 Hz — reads the committed trajectory and the verdict on it, makes setpoints (for the
/// flight controller). Everything is in `odom`.
///
/// It alone owns the committed trajectory: planning proposes, guidance splices the proposal to what
/// is being flown and gives it its number. It obeys the verdict: what is not clear is flown up to
/// the braking distance before `clear_until`, and silence is a stop. A stop brakes along the
/// trajectory, so that it stays where it was checked (motion/braking.h). Reads no clock, and
/// allocates nothing after its constructor: trajectories take turns in memory of its own, as long
/// as others let go of old ones. Cost: microseconds, but for a splice or a stop.
namespace saker::autonomy {

struct GuidanceConfig {
  double setpoint_expiry_s = 0.3;
  double verdict_silence_s = 0.35;
  double stop_margin_s = 0.15;
  motion::BrakingConfig braking;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("setpoint_expiry_s", setpoint_expiry_s, {0.04, 2}, "s",
            "after which a setpoint is no longer obeyed: fifteen missed ones");
    v.field("verdict_silence_s", verdict_silence_s, {0.15, 5}, "s",
            "without a verdict, or without one on a new trajectory, then stop: four of 10 Hz");
    v.field("stop_margin_s", stop_margin_s, {0, 2}, "s",
            "at rest so long before the time to which the trajectory is clear");
    v.group("braking", braking, "how it comes to rest");
  }
};

enum class GuidanceOrder {
  silent,  ///< no setpoints: the flight controller is on its own (ground, landing, lost)
  hold,    ///< stop, stay
  follow   ///< fly what is committed
};

[[nodiscard]] const char* to_string(GuidanceOrder order);

/// A trajectory that planning would like to be flown.
struct Proposal {
  motion::Trajectory trajectory;  ///< from `start` on; its id is not used
  std::int64_t from_id = 0;       ///< the committed trajectory at whose state at `start` it begins
};

/// The last time that guidance stopped on the way: by the verdict, or told to.
struct GuidanceStop {
  int count = 0;      ///< of all stops so far
  core::Text reason;  ///< of the last one
};

enum class CommitStatus {
  committed,
  late,     ///< its start has passed
  other,    ///< what it begins on is no longer flown
  refused,  ///< guidance does not follow now
};

[[nodiscard]] const char* to_string(CommitStatus status);

class Guidance {
 public:
  explicit Guidance(const GuidanceConfig& config);  ///< throws Error on an invalid value

  /// Begins anew: stay at the pose. For the end of the take-off, and where the vehicle could not
  /// follow.
  void anchor(Time now, const VehicleOdometry& odometry);

  /// Commits a proposal: from its start on it is flown.
  CommitStatus commit(const Proposal& proposal, Time now);

  /// The newest verdict decides; nothing while silent.
  [[nodiscard]] std::optional<Setpoint> update(Time now, GuidanceOrder order,
                                               const std::optional<motion::Verdict>& verdict);

  /// What is flown now; empty before the first anchor. A new object after every change.
  [[nodiscard]] const std::shared_ptr<const motion::Trajectory>& committed() const {
    return committed_;
  }
  [[nodiscard]] const GuidanceStop& last_stop() const { return last_stop_; }

 private:
  [[nodiscard]] std::shared_ptr<motion::Trajectory> unused() const;
  void replace(std::shared_ptr<motion::Trajectory> trajectory, Time now);
  void stop(Time now, const core::Text& reason);
  [[nodiscard]] std::optional<core::Text> reason_to_stop(
      Time now, const std::optional<motion::Verdict>& verdict) const;

  GuidanceConfig config_;
  std::array<std::shared_ptr<motion::Trajectory>, 8> memory_;  // one that only this holds is free
  std::shared_ptr<const motion::Trajectory> committed_;
  std::int64_t last_id_ = 0;
  Time committed_at_ = 0;
  GuidanceOrder order_ = GuidanceOrder::silent;
  bool stopping_ = false;
  GuidanceStop last_stop_;
};

/// Stays at a pose: one state, at rest.
/// \param memory  for the states, as in motion::braked
[[nodiscard]] motion::Trajectory resting(Time start, const motion::MotionState& state,
                                         std::vector<motion::MotionState> memory = {});

/// `first` up to the start of `second`, then `second`, on the second's steps.
[[nodiscard]] motion::Trajectory spliced(const motion::Trajectory& first,
                                         const motion::Trajectory& second, Time now,
                                         std::vector<motion::MotionState> memory = {});

}  // namespace saker::autonomy
