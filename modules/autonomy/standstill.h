#pragma once

#include <span>
#include <vector>

#include "saker/core/config.h"
#include "saker/lidar/scan.h"

namespace saker::autonomy {

struct StandstillConfig {
  double window_s = 1.0;
  double acceleration_mps2 = 0.4;
  double rate_rps = 0.1;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("window_s", window_s, {0.1, 30}, "s", "of rest before odometry begins");
    v.field("acceleration_mps2", acceleration_mps2, {0.01, 10}, "m/s²",
            "most difference of a sample to their mean: an IMU at rest has a twentieth");
    v.field("rate_rps", rate_rps, {1e-3, 2}, "rad/s", "the same of the turn rate");
  }
};

/// Whether the vehicle has stood still: then its IMU says which way is up. A vehicle that still
/// sways on its legs would tilt the whole map.
class Standstill {
 public:
  explicit Standstill(const StandstillConfig& config);  ///< throws Error on an invalid value

  void add(std::span<const lidar::ImuSample> samples);

  [[nodiscard]] bool reached() const;

  /// Of the last window.
  [[nodiscard]] const std::vector<lidar::ImuSample>& samples() const { return samples_; }

 private:
  static constexpr std::size_t kMost = 16384;  // 2 s at the fastest IMU's rate, 8 kHz

  StandstillConfig config_;
  std::vector<lidar::ImuSample> samples_;
};

}  // namespace saker::autonomy
