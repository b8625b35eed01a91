#pragma once

#include <algorithm>
#include <chrono>
#include <mutex>
#include <optional>
#include <utility>

#include "flight/bus/priority_mutex.h"
#include "saker/core/time.h"

namespace saker::flight {

/// The sensor's time in every thread of the executive, from stamps that come late.
///
/// Of the stamps of the last one to two seconds the least late one counts, so that it follows a
/// sensor whose clock runs otherwise or falls behind. It is flown by: it never jumps, but runs up
/// to a tenth faster or slower until it is right. Stamps are the gate's (sensor_gate.h), which go
/// on where the sensor's clock stepped; one that is more than 10 s off is none of them.
class SharedClock {
 public:
  using Steady = std::chrono::steady_clock;

  void hear(Time stamp, Steady::time_point received = Steady::now()) {
    const Time at = nanoseconds(received);
    const Time offset = stamp - at;
    const std::lock_guard lock(mutex_);
    if (!offset_) {
      offset_ = before_ = window_ = offset;
      window_begin_ = heard_ = at;
      return;
    }
    if (offset < *offset_ - kMostOff || offset > *offset_ + kMostOff) return;
    if (at - window_begin_ > kWindow) {
      before_ = std::exchange(window_, offset);
      window_begin_ = at;
    }
    window_ = std::max(window_, offset);
    const Time most = std::max<Time>(at - heard_, 0) / kSlowest;
    *offset_ += std::clamp(std::max(before_, window_) - *offset_, -most, most);
    heard_ = at;
  }

  /// 0 before the first stamp.
  [[nodiscard]] Time now(Steady::time_point steady = Steady::now()) const {
    const std::lock_guard lock(mutex_);
    return offset_ ? *offset_ + nanoseconds(steady) : 0;
  }

 private:
  static constexpr Time kWindow = kNanosecondsPerSecond;
  static constexpr Time kMostOff = 10 * kNanosecondsPerSecond;
  static constexpr Time kSlowest = 10;  // one part in so many

  static Time nanoseconds(Steady::time_point time) {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(time.time_since_epoch()).count();
  }

  mutable PriorityMutex mutex_;
  std::optional<Time> offset_;
  Time before_ = 0, window_ = 0;  // the best offsets of the last whole window and of this one
  Time window_begin_ = 0;
  Time heard_ = 0;
};

}  // namespace saker::flight
