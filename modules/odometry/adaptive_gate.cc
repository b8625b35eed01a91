#include "saker/odometry/adaptive_gate.h"

#include <algorithm>
#include <cmath>

namespace saker::odometry {

AdaptiveGate::AdaptiveGate(const AdaptiveGateConfig& config) : config_(config) { reset(); }

void AdaptiveGate::reset() {
  mean_square_ = config_.initial_m * config_.initial_m / 9;
  settled_ = false;
}

double AdaptiveGate::gate_m(double stretch, const Matrix6d& predicted) const {
  const double stated =
      3 * std::sqrt(predicted.bottomRightCorner<3, 3>().trace() +
                    config_.range_m * config_.range_m * predicted.topLeftCorner<3, 3>().trace());
  const double learnt =
      settled_ ? std::min(3 * std::sqrt(mean_square_) * std::max(1.0, stretch), config_.most_m)
               : config_.initial_m;
  return std::max(std::min(learnt, stated), config_.least_m);
}

void AdaptiveGate::learn(const SE3& deviation) {
  const double angle = core::so3_log(deviation.linear()).norm();
  const double metres =
      deviation.translation().norm() + 2 * config_.range_m * std::sin(angle / 2);  // eq. 8
  if (settled_ && metres < config_.least_deviation_m) return;
  const double keep = settled_ ? config_.memory : 0.5;
  mean_square_ = keep * mean_square_ + (1 - keep) * metres * metres;
  settled_ = true;
}

}  // namespace saker::odometry
