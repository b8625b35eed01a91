#pragma once

#include <chrono>
#include <optional>

#include "saker/core/time.h"

namespace saker::flight {

/// The time of the sensor's clock in a process that hears its stamps late: the newest stamp, and
/// how long ago it came. Of stamps that are late by different times the least late one counts.
class SensorClock {
 public:
  using Steady = std::chrono::steady_clock;

  /// Stamps that go back by more than a second are of a clock that began anew.
  void hear(Time stamp, Steady::time_point received) {
    const Time offset = stamp - nanoseconds(received);
    if (!offset_ || offset > *offset_ || offset < *offset_ - kNanosecondsPerSecond)
      offset_ = offset;
  }

  /// Nothing before the first stamp.
  [[nodiscard]] std::optional<Time> at(Steady::time_point now) const {
    if (!offset_) return std::nullopt;
    return *offset_ + nanoseconds(now);
  }

 private:
  static Time nanoseconds(Steady::time_point time) {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(time.time_since_epoch()).count();
  }

  std::optional<Time> offset_;
};

}  // namespace saker::flight
