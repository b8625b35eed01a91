#pragma once

#include <cstdint>

namespace saker::lidar {

inline constexpr int kMostFramesLost = 1000;  ///< a wider gap is a restart

/// Steps from one 16-bit frame number to another, the short way round.
[[nodiscard]] inline int frames_between(int from, int to) {
  return static_cast<std::int16_t>(static_cast<std::uint16_t>(to - from));
}

}  // namespace saker::lidar
