#pragma once

#include <array>
#include <optional>
#include <span>

#include "saker/core/se3.h"
#include "saker/lidar/scan.h"

namespace saker::odometry {

/// Rotation over an interval by the gyroscope, at evenly spaced knots: R_begin_knot.
struct RotationTrack {
  static constexpr int kSteps = 128;
  std::array<Eigen::Matrix3d, kSteps + 1> R_begin_knot;

  /// Of samples in the order of time, their `bias` taken off; what is not finite or out of order is
  /// skipped.
  [[nodiscard]] static RotationTrack integrated(std::span<const lidar::ImuSample> imu, Time begin,
                                                Time end, const Eigen::Vector3d& bias);
};

/// Whether the samples leave no stretch of the interval longer than `gap_s` without one.
[[nodiscard]] bool covers(std::span<const lidar::ImuSample> imu, Time begin, Time end,
                          double gap_s);

/// Roll and pitch of the lidar from the mean specific force: R_level_lidar, yaw 0; the identity
/// without usable samples. Assumes that the sensor stands, hovers or keeps its speed.
[[nodiscard]] Eigen::Matrix3d level(std::span<const lidar::ImuSample> imu);

}  // namespace saker::odometry
