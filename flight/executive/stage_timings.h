#pragma once

#include <string>

#include "saker/core/timings.h"

namespace saker::flight {

/// Times of the stages, ingestion's apart: it has a real-time priority, the others have none, and
/// the lock of core::Timings lends none. So it never waits for who was preempted while he held it.
struct StageTimings {
  core::Timings ingestion{{"odometry"}};
  core::Timings ordinary{{"segmentation", "mapping", "planning"}};

  /// timings.csv: one table of both.
  [[nodiscard]] std::string csv() const {
    const std::string more = ordinary.csv();
    return ingestion.csv() + more.substr(more.find('\n') + 1);
  }
};

}  // namespace saker::flight
