#pragma once

#include <array>
#include <optional>
#include <span>

#include "core/config.h"
#include "core/se3.h"
#include "lidar/scan.h"

namespace saker::odometry {

struct GyroConfig {
  double max_gap_s = 0.05;
  double initial_bias_rps = 0.02;
  double bias_walk_rps = 0.0005;
  double rate_sd_rps = 0.02;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("max_gap_s", max_gap_s, {0.001, 1}, "s",
            "longest stretch without a sample; beyond, the gyroscope is not used");
    v.field("initial_bias_rps", initial_bias_rps, {0, 1}, "rad/s", "sd of the bias at switch-on");
    v.field("bias_walk_rps", bias_walk_rps, {0, 0.1}, "rad/s/sqrt(s)", "random walk of the bias");
    v.field("rate_sd_rps", rate_sd_rps, {1e-4, 1}, "rad/s",
            "sd of the rate over a scan: noise, scale, vibration");
  }
};

/// Rotation over an interval, at evenly spaced knots: R_begin_knot.
struct RotationTrack {
  static constexpr int kSteps = 128;
  std::array<Eigen::Matrix3d, kSteps + 1> R_begin_knot;

  [[nodiscard]] const Eigen::Matrix3d& R_begin_end() const { return R_begin_knot.back(); }
};

/// Turns gyroscope samples into rotations, and learns the gyroscope's bias from the rotations that
/// registration found (a scalar Kalman filter an axis).
class Gyro {
 public:
  explicit Gyro(const GyroConfig& config);

  /// Samples in the order of time; what is not finite or out of order is skipped. Nothing when they
  /// leave a gap.
  [[nodiscard]] std::optional<RotationTrack> integrate(std::span<const lidar::ImuSample> imu,
                                                       Time begin, Time end) const;

  /// `measured`: the rotation over the interval found otherwise, its error `sd_rad`.
  void correct(const Eigen::Matrix3d& integrated, const Eigen::Matrix3d& measured, double seconds,
               double sd_rad);

  [[nodiscard]] const Eigen::Vector3d& bias() const { return bias_; }
  [[nodiscard]] double rate_sd() const;  ///< of a rotation's mean rate, bias included

 private:
  GyroConfig config_;
  Eigen::Vector3d bias_ = Eigen::Vector3d::Zero();
  double bias_variance_;
};

/// Roll and pitch of the lidar from the mean specific force: R_level_lidar, yaw 0; the identity
/// without usable samples. Assumes that the sensor stands, hovers or keeps its speed.
[[nodiscard]] Eigen::Matrix3d level(std::span<const lidar::ImuSample> imu);

}  // namespace saker::odometry
