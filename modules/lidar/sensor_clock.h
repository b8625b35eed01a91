#pragma once

#include "saker/core/time.h"
#include "saker/lidar/sensor_info.h"

namespace saker::lidar {

/// A sensor's clock without its steps: how much time passed between two columns is told by how many
/// came between them, which a clock that is set (PTP found its master, a restart) cannot change.
///
/// A step is believed when two columns in a row agree on it; what came between is left as it is.
/// After a restart, when columns are numbered anew, nobody knows how long it took: a frame's
/// period. Times are never negative; any may come.
class SensorClock {
 public:
  explicit SensorClock(const SensorInfo& info);

  /// A column of a packet, in the order in which they came.
  void hear(int frame_id, int column, Time stamp);

  /// ns to add to stamps of now, and to those before the last step.
  [[nodiscard]] Time correction() const { return correction_; }
  [[nodiscard]] Time correction_before() const { return correction_before_; }
  /// The last column did not agree; the next one tells whether that was a step.
  [[nodiscard]] bool doubted() const { return doubted_; }
  [[nodiscard]] int steps() const { return steps_; }

 private:
  struct Heard {
    int frame_id = 0, column = 0;
    Time stamp = 0;
  };

  [[nodiscard]] Time expected_since(const Heard& from, const Heard& to) const;
  [[nodiscard]] bool agrees(const Heard& from, const Heard& to) const;

  int columns_;
  double column_period_s_;
  bool any_ = false, doubted_ = false;
  Heard last_, doubtful_;
  Time correction_ = 0, correction_before_ = 0;
  int steps_ = 0;
};

}  // namespace saker::lidar
