#pragma once

#include <cstdint>

namespace saker {

/// Nanoseconds of the sensor's clock.
using Time = std::int64_t;

constexpr Time kNanosecondsPerSecond = 1'000'000'000;

/// Seconds as a double: for differences and files, never for comparing stamps.
constexpr double to_seconds(Time time) { return static_cast<double>(time) * 1e-9; }

constexpr Time from_seconds(double seconds) {
  return static_cast<Time>(seconds * 1e9 + (seconds < 0 ? -0.5 : 0.5));
}

}  // namespace saker
