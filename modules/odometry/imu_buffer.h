#pragma once

#include <span>
#include <vector>

#include "saker/lidar/scan.h"

namespace saker::odometry {

/// The IMU's newest samples, in the order of time. What is not newer than the last one is left out.
class ImuBuffer {
 public:
  static constexpr std::size_t kMost = 8192;  // 2 s at 4 kHz

  /// Drops samples before `oldest`, then adds.
  void add(std::span<const lidar::ImuSample> samples, Time oldest) {
    std::erase_if(samples_, [oldest](const lidar::ImuSample& s) { return s.stamp < oldest; });
    for (const lidar::ImuSample& sample : samples) {
      const bool newer = samples_.empty() || sample.stamp > samples_.back().stamp;
      if (newer && sample.stamp >= oldest && samples_.size() < kMost) samples_.push_back(sample);
    }
  }
  [[nodiscard]] std::span<const lidar::ImuSample> samples() const { return samples_; }

 private:
  std::vector<lidar::ImuSample> samples_;
};

}  // namespace saker::odometry
