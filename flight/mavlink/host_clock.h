#pragma once

#include <chrono>

#include "flight/mavlink/signing.h"
#include "saker/core/time.h"

namespace saker::flight::mavlink {

/// The host's steady clock, ns.
[[nodiscard]] inline Time host_now() {
  using namespace std::chrono;
  return duration_cast<nanoseconds>(steady_clock::now().time_since_epoch()).count();
}

/// The system clock as signatures have it.
[[nodiscard]] inline SigningTime signing_now() {
  using namespace std::chrono;
  return signing_time(duration_cast<microseconds>(system_clock::now().time_since_epoch()).count());
}

}  // namespace saker::flight::mavlink
