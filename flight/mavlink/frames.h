#pragma once

#include <Eigen/Geometry>
#include <array>

#include "saker/core/se3.h"

/// Our frames ↔ the autopilot's.
///
/// Ours: `odom` has z up, x along the heading at take-off and y to its left; `body` is FLU
/// (forward, left, up). The autopilot's: NED, of which north is our `odom` x (its heading comes
/// from our odometry, no compass is asked), and FRD (forward, right, down). Both pairs differ by
/// half a turn about x, which is its own inverse: one function serves both ways. Yaw changes its
/// sign.
namespace saker::flight::mavlink {

/// odom ↔ NED, body FLU ↔ body FRD: positions, velocities, accelerations, angular velocities.
[[nodiscard]] inline Eigen::Vector3d flipped(const Eigen::Vector3d& v) {
  return {v.x(), -v.y(), -v.z()};
}

/// odom ← FLU to NED ← FRD, and back.
[[nodiscard]] inline Eigen::Quaterniond flipped(const Eigen::Quaterniond& q) {
  return {q.w(), q.x(), -q.y(), -q.z()};
}

/// rad, in (−π, π]; yaw rates change their sign alone.
[[nodiscard]] double flipped_yaw(double yaw);

/// [w, x, y, z] as MAVLink has it: unit to 1e-7, w ≥ 0.
[[nodiscard]] std::array<float, 4> wire_quaternion(const Eigen::Quaterniond& q);

/// Nothing of a rotation where its norm is off by more than 1e-3, or no number: then the identity
/// with `valid` false.
struct WireRotation {
  Eigen::Quaterniond q = Eigen::Quaterniond::Identity();
  bool valid = false;
};
[[nodiscard]] WireRotation rotation_of(float w, float x, float y, float z);

/// Roll, pitch and yaw of FRD in NED (ATTITUDE) as a rotation of FLU in `odom`.
[[nodiscard]] Eigen::Quaterniond rotation_of_angles(double roll, double pitch, double yaw);

/// The pose's covariance for ODOMETRY: the upper triangle, row by row, of x, y, z, roll, pitch,
/// yaw; place in NED, rotation about the axes of FRD. \param covariance  ours: [rotation,
/// translation], right perturbation, in body
[[nodiscard]] std::array<float, 21> wire_covariance(const Matrix6d& covariance,
                                                    const Eigen::Matrix3d& R_odom_body);

}  // namespace saker::flight::mavlink
