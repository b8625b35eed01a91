#include "saker/lidar/sensor_clock.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "saker/lidar/frame_number.h"

namespace saker::lidar {
namespace {

constexpr double kLeastStep_s = 0.1;     // jitter of stamps and order is far below
constexpr double kLeastStepShare = 0.1;  // of the time between: motors are not that uneven

/// As a sum without a sign: any stamps may come.
Time plus(Time a, Time b) {
  return static_cast<Time>(static_cast<std::uint64_t>(a) + static_cast<std::uint64_t>(b));
}

}  // namespace

SensorClock::SensorClock(const SensorInfo& info)
    : columns_(info.columns), column_period_s_(info.column_period_s()) {}

Time SensorClock::expected_since(const Heard& from, const Heard& to) const {
  const int frames = frames_between(from.frame_id, to.frame_id);
  if (frames < -1 || frames > kMostFramesLost) return from_seconds(columns_ * column_period_s_);
  return from_seconds((static_cast<double>(frames) * columns_ + to.column - from.column) *
                      column_period_s_);
}

bool SensorClock::agrees(const Heard& from, const Heard& to) const {
  const double expected = to_seconds(expected_since(from, to));
  const double passed = to_seconds(to.stamp - from.stamp);  // neither is negative
  return std::abs(passed - expected) <= std::max(kLeastStep_s, kLeastStepShare * expected);
}

void SensorClock::hear(int frame_id, int column, Time stamp) {
  if (stamp < 0) return;
  const Heard heard{frame_id, column, stamp};
  if (!any_ || agrees(last_, heard)) {
    any_ = true;
    doubted_ = false;
    last_ = heard;
    return;
  }
  if (!doubted_ || !agrees(doubtful_, heard)) {
    doubted_ = true;
    doubtful_ = heard;
    return;
  }
  correction_before_ = correction_;
  correction_ = plus(correction_, plus(last_.stamp - stamp, expected_since(last_, heard)));
  ++steps_;
  doubted_ = false;
  last_ = heard;
}

}  // namespace saker::lidar
