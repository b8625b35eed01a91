#pragma once

#include <atomic>
#include <functional>
#include <limits>

#include "flight/bus/bus.h"
#include "flight/executive/blackboard.h"
#include "flight/executive/loop.h"
#include "saker/autonomy/supervisor.h"

namespace saker::flight {

/// What the safety loop is made with; each function is called in its thread.
struct SafetyParts {
  /// The ladder and the mission: Supervisor::step.
  std::function<autonomy::Mission::Output(autonomy::SupervisorInput)> step;
  std::function<bool()> mission_done;
  /// By a signal: asked here, so that it is obeyed whoever else hangs.
  std::function<bool()> land_ordered;
  bool has_targets = false;
};

/// The loop of safety and mission, 50 Hz — reads ages and values from the blackboard, makes orders
/// (for guidance, planning), commands (for the flight controller) and events. It waits for nobody
/// but for who copies a small value, and in flight allocates nothing but the answer to an
/// operator's order.
///
/// Last resort: where its step throws kMostThrows times in a row (0.1 s, in which what was ordered
/// holds), there is no mission any more. Setpoints end, so that the flight controller holds, and it
/// is told to land, again and again until it says that it is disarmed, after a refusal by a new
/// command; on the ground the flight ends. No way leads back.
class SafetyLoop {
 public:
  static constexpr int kMostThrows = 5;

  /// What is given has to outlive this.
  SafetyLoop(SafetyParts parts, Blackboard& board, Bus& bus);

  LoopStatus run();  ///< throws what the step throws

  /// Any thread.
  [[nodiscard]] bool lands_alone() const { return lands_alone_; }

 private:
  [[nodiscard]] autonomy::SupervisorInput seen(Time now);
  void obey(const autonomy::Mission::Output& output, Time now);
  void land_alone(Time now);

  const SafetyParts parts_;
  Blackboard& board_;
  Bus& bus_;
  int anchors_ = 0;
  int throws_ = 0;  // in a row
  std::atomic<bool> lands_alone_ = false;
  std::int64_t last_command_ = 0;
  static constexpr Time kNever = std::numeric_limits<Time>::max();
  Time commanded_ = 0;  // to land alone
  Time anew_ = kNever;  // from when on by another command
};

}  // namespace saker::flight
