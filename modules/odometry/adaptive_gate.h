#pragma once

#include "saker/core/config.h"
#include "saker/core/se3.h"

namespace saker::odometry {

struct AdaptiveGateConfig {
  double initial_m = 2.0;
  double least_m = 0.3;
  double most_m = 3.0;
  double least_deviation_m = 0.02;
  double memory = 0.95;
  double range_m = 50;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("initial_m", initial_m, {0.05, 20}, "m",
            "gate of the first registration, when nothing is known of the motion");
    v.field("least_m", least_m, {0.02, 10}, "m",
            "never tighter: noise, and what a plane of a voxel leaves out");
    v.field("most_m", most_m, {0.05, 20}, "m", "never wider");
    v.field("least_deviation_m", least_deviation_m, {0, 1}, "m",
            "smaller deviations teach nothing (KISS-ICP's delta_min)");
    v.field("memory", memory, {0, 0.999}, "", "share of the old mean square that a scan keeps");
    v.field("range_m", range_m, {1, 300}, "m", "range at which a rotation's deviation is counted");
  }
};

/// How far from the map a point may be at the start of registration: three times the root mean
/// square of how much the last predictions were wrong. Vizzo et al., "KISS-ICP" (RA-L 2023), eq.
/// 4–9, with a memory that fades; and no farther than three deviations that the prediction states.
class AdaptiveGate {
 public:
  explicit AdaptiveGate(const AdaptiveGateConfig& config);

  /// `stretch`: time since the last scan, in usual intervals; `predicted`: covariance of the pose
  /// that registration starts from, tangent [rotation, translation].
  [[nodiscard]] double gate_m(double stretch, const Matrix6d& predicted) const;
  [[nodiscard]] bool settled() const { return settled_; }

  /// The prediction was wrong by this much: prediction⁻¹ · pose.
  void learn(const SE3& deviation);
  void reset();

 private:
  AdaptiveGateConfig config_;
  double mean_square_;
  bool settled_ = false;
};

}  // namespace saker::odometry
