#pragma once

#include <cmath>

#include "saker/core/time.h"
#include "saker/lidar/frame_number.h"
#include "saker/lidar/sensor_info.h"
#include "saker/lidar/sensor_reading.h"

namespace saker::lidar {

/// How much time passed between two columns, by how many came between them: what a clock that is
/// set cannot change.
class ColumnCount {
 public:
  explicit ColumnCount(const SensorInfo& info)
      : columns_(info.columns), period_s_(info.column_period_s()), rate_hz_(info.frame_rate_hz) {}

  /// s; negative: `to` came before. Frames are counted the short way round.
  [[nodiscard]] double seconds(const ColumnTime& from, const ColumnTime& to) const {
    const double frames = frames_between(from.frame_id, to.frame_id);
    return (frames * columns_ + to.column - from.column) * period_s_;
  }

  /// Whether their stamps agree with that.
  [[nodiscard]] bool agrees(const ColumnTime& from, const ColumnTime& to) const {
    const double expected = seconds(from, to);
    return std::abs(to_seconds(to.stamp - from.stamp) - expected) <=
           kTolerance / rate_hz_ + kToleranceShare * std::abs(expected);
  }

 private:
  static constexpr double kTolerance = 0.02;       // of a revolution; real ones err by 1e-4
  static constexpr double kToleranceShare = 0.02;  // motors are not that uneven

  int columns_;
  double period_s_, rate_hz_;
};

}  // namespace saker::lidar
