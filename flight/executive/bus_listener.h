#pragma once

#include <atomic>
#include <optional>

#include "flight/bus/bus.h"
#include "flight/bus/occupancy_messages.h"
#include "flight/executive/blackboard.h"

namespace saker::flight {

/// `_STATE`, `_COMMAND_ACK`, `_VERDICT`, `_OCCUPANCY` → blackboard, on the thread that handles the
/// bus.
///
/// The others' stamps are in the sensor's time, as their clocks have it, and safety takes ages by
/// them: one of the future would be fresh until then. So a stamp is the arrival's at the latest,
/// and what lies farther ahead than kMostAhead comes from another clock: it is refused and counted.
/// Before the sensor's time is known nothing has an age, and nothing is kept.
class BusListener {
 public:
  /// As long as a state or a verdict may be silent, so that no age is wrong by more; the
  /// executive's clock lags by less where it catches up with the sensor's (shared_clock.h).
  static constexpr Time kMostAhead = kNanosecondsPerSecond / 2;

  /// Subscribes to `bus`, which has to outlive this, as `board` has.
  BusListener(Blackboard& board, Bus& bus);

  /// Messages of the future. Any thread.
  [[nodiscard]] long ahead() const { return ahead_; }

 private:
  /// The stamp by which its age is taken; nothing: it is not to be kept.
  [[nodiscard]] std::optional<Time> at_arrival(Time stamp);
  template <class Message, class Box>
  void keep(Bus& bus, Box& box);
  bool join(const occupancy_t& chunk);

  Blackboard& board_;
  OccupancyJoiner grid_joiner_;
  std::atomic<long> ahead_ = 0;
};

}  // namespace saker::flight
