#pragma once

#include "saker/core/time.h"

namespace saker::autonomy {

/// Stages whose results take time on the vehicle's computer.
enum class Stage { registration, segmentation, mapping, planning };

/// By how much a stage is slower than `latency` says: in lockstep a stage that hangs.
class StageDelays {
 public:
  virtual ~StageDelays() = default;

  /// s, on top, of what is begun at `now`; ≥ 0, at most 1e6. What follows waits behind it.
  [[nodiscard]] virtual double extra_s(Stage stage, Time now) const = 0;
};

}  // namespace saker::autonomy
