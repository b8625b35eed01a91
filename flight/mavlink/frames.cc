#include "flight/mavlink/frames.h"

#include <cmath>
#include <numbers>

namespace saker::flight::mavlink {
namespace {

constexpr double kOff = 1e-3;  // of a norm: single precision is a thousand times better

}  // namespace

double flipped_yaw(double yaw) {
  const double turned = std::remainder(-yaw, 2 * std::numbers::pi);
  return turned <= -std::numbers::pi ? std::numbers::pi : turned;
}

std::array<float, 4> wire_quaternion(const Eigen::Quaterniond& q) {
  const Eigen::Vector4d unit = q.coeffs().normalized() * (q.w() < 0 ? -1 : 1);
  return {static_cast<float>(unit(3)), static_cast<float>(unit(0)), static_cast<float>(unit(1)),
          static_cast<float>(unit(2))};
}

WireRotation rotation_of(float w, float x, float y, float z) {
  const Eigen::Quaterniond q(static_cast<double>(w), static_cast<double>(x), static_cast<double>(y),
                             static_cast<double>(z));
  if (!(std::abs(q.norm() - 1) < kOff)) return {};
  return {flipped(q.normalized()), true};
}

Eigen::Quaterniond rotation_of_angles(double roll, double pitch, double yaw) {
  using Eigen::AngleAxisd, Eigen::Vector3d;
  const Eigen::Quaterniond q_ned_frd = AngleAxisd(yaw, Vector3d::UnitZ()) *
                                       AngleAxisd(pitch, Vector3d::UnitY()) *
                                       AngleAxisd(roll, Vector3d::UnitX());
  return flipped(q_ned_frd);
}

std::array<float, 21> wire_covariance(const Matrix6d& covariance,
                                      const Eigen::Matrix3d& R_odom_body) {
  const Eigen::Matrix3d flip = Eigen::Vector3d(1, -1, -1).asDiagonal();
  // Ours is [rotation, translation] in body; theirs [place in NED, rotation in FRD].
  Matrix6d J = Matrix6d::Zero();
  J.topRightCorner<3, 3>() = flip * R_odom_body;
  J.bottomLeftCorner<3, 3>() = flip;
  const Matrix6d turned = J * covariance * J.transpose();
  std::array<float, 21> triangle{};
  std::size_t at = 0;
  for (int row = 0; row < 6; ++row)
    for (int column = row; column < 6; ++column)
      triangle[at++] = static_cast<float>(turned(row, column));
  return triangle;
}

}  // namespace saker::flight::mavlink
