#pragma once

#include <optional>

#include "saker/core/time.h"

namespace saker::autonomy {

/// Says which of a sequence of stamps a stage of a fixed rate takes: a function of the stamps
/// alone. Due times lie on a grid from the first stamp, so that the rate holds on average; a gap
/// skips the due times that it swallowed.
class Schedule {
 public:
  explicit Schedule(double rate_hz) : period_(from_seconds(1 / rate_hz)) {}

  [[nodiscard]] bool due(Time stamp) {
    if (!next_) next_ = stamp;
    if (stamp + period_ / 20 < *next_) return false;  // 5 % early counts: stamps of a sensor jitter
    while (*next_ <= stamp + period_ / 20) *next_ += period_;
    return true;
  }

 private:
  Time period_;
  std::optional<Time> next_;
};

}  // namespace saker::autonomy
