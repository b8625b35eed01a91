#pragma once

#include <map>
#include <utility>
#include <vector>

#include "tools/saker/faults/fault.h"

namespace saker::tools {

/// One channel of a mission, whose messages are lost, late or there twice as the schedule says.
/// What was late may come after what was sent later, as over a network.
template <class T>
class FaultyLine {
 public:
  /// `schedule` has to outlive this.
  FaultyLine(const FaultSchedule& schedule, FaultPlace place)
      : schedule_(schedule), place_(place), rng_(static_cast<std::uint64_t>(place) + 100) {}

  void put(double t_s, T value) {
    if (strikes(FaultKind::lose, t_s)) return;
    const Fault* late = acting(schedule_, FaultKind::delay, place_, t_s);
    const double due_s = t_s + (late != nullptr ? late->strength : 0);
    if (strikes(FaultKind::repeat, t_s)) waiting_.emplace(due_s + kAgain_s, value);
    waiting_.emplace(due_s, std::move(value));
  }

  /// What is due, in its order.
  [[nodiscard]] std::vector<T> take(double t_s) {
    std::vector<T> due;
    const auto end = waiting_.upper_bound(t_s);
    for (auto it = waiting_.begin(); it != end; ++it) due.push_back(std::move(it->second));
    waiting_.erase(waiting_.begin(), end);
    return due;
  }

 private:
  static constexpr double kAgain_s = 0.005;  // from a message to its copy

  [[nodiscard]] bool strikes(FaultKind kind, double t_s) {
    const Fault* fault = acting(schedule_, kind, place_, t_s);
    return fault != nullptr && rng_.chance(fault->strength);
  }

  const FaultSchedule& schedule_;
  FaultPlace place_;
  core::Rng rng_;
  std::multimap<double, T> waiting_;  // by when they are due
};

}  // namespace saker::tools
