#pragma once

#include <algorithm>
#include <utility>

#include "saker/core/time.h"

namespace saker::lidar {

/// How a sensor's stamps run against their arrival. Of the offsets (stamp − arrival) the least late
/// one counts, of the last ten seconds; it rises by a thousandth of the time at most, which is far
/// beyond what clocks drift and far below what packets ahead of time would need to carry it along.
class StampLine {
 public:
  static constexpr double kMostAhead_s = 0.02;  ///< one that was late before, and is not any more
  static constexpr double kMostLate_s = 1;      ///< on its way, or a sensor that falls behind

  enum class Place { on, ahead, late };

  void begin(Time offset, Time arrival) {
    offset_ = before_ = window_ = offset;
    window_begin_ = heard_ = arrival;
  }

  [[nodiscard]] Place judge(Time offset) const {
    const double ahead = to_seconds(offset - offset_);
    return ahead > kMostAhead_s ? Place::ahead : ahead < -kMostLate_s ? Place::late : Place::on;
  }

  /// One that is on it.
  void follow(Time offset, Time arrival) {
    if (arrival - window_begin_ > kWindow) {
      before_ = std::exchange(window_, offset);
      window_begin_ = arrival;
    }
    window_ = std::max(window_, offset);
    const Time most = std::max<Time>(arrival - heard_, 0) / kSlowest;
    offset_ = std::min(std::max(before_, window_), offset_ + most);
    heard_ = std::max(heard_, arrival);
  }

  [[nodiscard]] Time offset() const { return offset_; }

 private:
  static constexpr Time kWindow = 5 * kNanosecondsPerSecond;
  static constexpr Time kSlowest = 1000;  // one part in so many

  Time offset_ = 0;
  Time before_ = 0, window_ = 0;  // the best of the last whole window and of this one
  Time window_begin_ = 0, heard_ = 0;
};

}  // namespace saker::lidar
