#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <vector>

#include "saker/active/views/viewpoint.h"

namespace saker::active {

/// How long something is flown to before it is given up.
struct GoalLimits {
  double patience_s = 20;   ///< without coming nearer or seeing something new
  double standing_s = 8;    ///< the same while the vehicle stands
  double progress_m = 0.5;  ///< that counts as nearer
  double refused_m = 0;     ///< around a viewpoint that was given up none is flown to
  int most_refusals = 1;    ///< viewpoints given up, until the attempt is
  int most_goals = 1;       ///< viewpoints flown to without seeing something new, likewise
  int attempts = 1;
  double arrived_m = 0;  ///< so near to the viewpoint time counts as dwell
  double dwell_s = std::numeric_limits<double>::infinity();
};

/// How far the flight to one target, or to one stop of the sweep, has come.
///
/// Reads what happens on the way there: a viewpoint that is chosen, progress, a new view, a refusal
/// of motion planning. Makes the phase. Every sequence of events without a new view ends in
/// `exhausted` or `reached`: nothing is flown to for ever. Frames: places are in `world`, m.
///
///     waiting ── fly_to ──▸ approaching ── dwell_s at the viewpoint ──▸ reached
///        ▴                     │
///        ├── viewpoint given up (no progress, refused)
///        └── put_off ◂── most_refusals, most_goals, give_up ──▸ exhausted, after all attempts
class TargetState {
 public:
  enum class Phase {
    waiting,      ///< for a viewpoint to fly to
    approaching,  ///< its viewpoint
    reached,      ///< it was at the viewpoint for a dwell
    put_off,      ///< this attempt failed, a later one may follow
    exhausted,    ///< the last attempt failed
  };

  explicit TargetState(const GoalLimits& limits = {}) : limits_(limits) {}

  /// A viewpoint was chosen. One too many without a new view gives the attempt up.
  Phase fly_to(const Viewpoint& viewpoint, const Eigen::Vector3d& vehicle);

  /// The vehicle flew on for `elapsed_s`. Gives the viewpoint up without progress.
  Phase update(const Eigen::Vector3d& vehicle, double elapsed_s, bool stands);

  /// Something was seen that was not seen before: patience begins anew.
  void see_new();

  /// There is no way to the viewpoint, or no progress: it is given up.
  Phase refuse();

  /// The attempt fails: there is no viewpoint left.
  Phase give_up();

  /// The viewpoint is left without being given up: another target is flown to, or this is closed.
  void leave();

  [[nodiscard]] Phase phase() const { return phase_; }

  /// Nothing changes any more.
  [[nodiscard]] bool ended() const {
    return phase_ == Phase::reached || phase_ == Phase::exhausted;
  }

  [[nodiscard]] const std::optional<Viewpoint>& goal() const { return goal_; }
  [[nodiscard]] double closest_m() const { return closest_m_; }  ///< to the last goal
  [[nodiscard]] int attempts() const { return attempts_; }       ///< that failed

  /// Whether a viewpoint at or beside `place` was given up in this attempt.
  [[nodiscard]] bool gave_up(const Eigen::Vector3d& place) const;

 private:
  GoalLimits limits_;
  Phase phase_ = Phase::waiting;
  std::optional<Viewpoint> goal_;
  double closest_m_ = std::numeric_limits<double>::infinity();  ///< that the vehicle came
  double idle_s_ = 0;                      ///< since it came nearer or saw something new
  double standing_s_ = 0;                  ///< since it moved or saw something new
  double dwell_s_ = 0;                     ///< at the goal
  std::vector<Eigen::Vector3d> given_up_;  ///< viewpoints, in this attempt
  int goals_ = 0;                          ///< in this attempt, since something new was seen
  int attempts_ = 0;                       ///< that failed
};

}  // namespace saker::active
