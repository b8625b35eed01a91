#include "saker/core/se3.h"

#include <cmath>

namespace saker::core {
namespace {

constexpr double kSmallAngle = 1e-4;  // below it the series' next term is under 1e-16

/// Coefficients (1 − cos θ)/θ² and (θ − sin θ)/θ³, and the same for the inverse Jacobian of SO(3).
struct Coefficients {
  double a, b;
};

Coefficients jacobian_coefficients(double angle) {
  if (angle < kSmallAngle) return {0.5 - angle * angle / 24, 1.0 / 6 - angle * angle / 120};
  return {(1 - std::cos(angle)) / (angle * angle),
          (angle - std::sin(angle)) / (angle * angle * angle)};
}

Eigen::Matrix3d so3_left_jacobian(const Eigen::Vector3d& rotation) {
  const auto [a, b] = jacobian_coefficients(rotation.norm());
  const Eigen::Matrix3d w = hat(rotation);
  return Eigen::Matrix3d::Identity() + a * w + b * w * w;
}

Eigen::Matrix3d so3_left_jacobian_inverse(const Eigen::Vector3d& rotation) {
  const double angle = rotation.norm();
  const Eigen::Matrix3d w = hat(rotation);
  const double c = angle < kSmallAngle ? 1.0 / 12 + angle * angle / 720
                                       : 1 / (angle * angle) - 0.5 / angle / std::tan(angle / 2);
  return Eigen::Matrix3d::Identity() - 0.5 * w + c * w * w;
}

/// Barfoot's Q: the lower left block of the left Jacobian of SE(3), eq. 7.86.
Eigen::Matrix3d coupling(const Eigen::Vector3d& rotation, const Eigen::Vector3d& translation) {
  const double t = rotation.norm(), t2 = t * t;
  const Eigen::Matrix3d w = hat(rotation), v = hat(translation);
  double c1 = 1.0 / 6, c2 = 1.0 / 24, c3 = 1.0 / 120;
  if (t > 1e-2) {
    c1 = (t - std::sin(t)) / (t2 * t);
    c2 = (t2 + 2 * std::cos(t) - 2) / (2 * t2 * t2);
    c3 = (2 * t - 3 * std::sin(t) + t * std::cos(t)) / (2 * t2 * t2 * t);
  } else {
    c1 -= t2 / 120;
    c2 -= t2 / 720;
    c3 -= t2 / 2520;
  }
  return 0.5 * v + c1 * (w * v + v * w + w * v * w) + c2 * (w * w * v + v * w * w - 3 * w * v * w) +
         c3 * (w * v * w * w + w * w * v * w);
}

}  // namespace

Eigen::Matrix3d hat(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

Eigen::Matrix3d so3_exp(const Eigen::Vector3d& rotation) {
  const double angle = rotation.norm();
  if (angle < kSmallAngle) {
    const Eigen::Matrix3d w = hat(rotation);
    return Eigen::Quaterniond(Eigen::Matrix3d(Eigen::Matrix3d::Identity() + w + 0.5 * w * w))
        .normalized()
        .toRotationMatrix();
  }
  return Eigen::AngleAxisd(angle, rotation / angle).toRotationMatrix();
}

Eigen::Vector3d so3_log(const Eigen::Matrix3d& rotation) {
  Eigen::Quaterniond q(rotation);
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  const double sine = q.vec().norm();
  const double angle = 2 * std::atan2(sine, q.w());
  return sine < kSmallAngle / 2 ? Eigen::Vector3d(2 * q.vec() / q.w())
                                : Eigen::Vector3d(q.vec() * (angle / sine));
}

SE3 se3_exp(const Vector6d& tangent) {
  SE3 T = SE3::Identity();
  T.linear() = so3_exp(tangent.head<3>());
  T.translation() = so3_left_jacobian(tangent.head<3>()) * tangent.tail<3>();
  return T;
}

Vector6d se3_log(const SE3& T) {
  Vector6d tangent;
  tangent.head<3>() = so3_log(T.linear());
  tangent.tail<3>() = so3_left_jacobian_inverse(tangent.head<3>()) * T.translation();
  return tangent;
}

Matrix6d se3_right_jacobian_inverse(const Vector6d& tangent) {
  const Eigen::Vector3d rotation = -tangent.head<3>(), translation = -tangent.tail<3>();
  const Eigen::Matrix3d inverse = so3_left_jacobian_inverse(rotation);
  Matrix6d J = Matrix6d::Zero();
  J.topLeftCorner<3, 3>() = inverse;
  J.bottomRightCorner<3, 3>() = inverse;
  J.bottomLeftCorner<3, 3>() = -inverse * coupling(rotation, translation) * inverse;
  return J;
}

Matrix6d se3_adjoint(const SE3& T) {
  Matrix6d A = Matrix6d::Zero();
  A.topLeftCorner<3, 3>() = T.linear();
  A.bottomRightCorner<3, 3>() = T.linear();
  A.bottomLeftCorner<3, 3>() = hat(T.translation()) * T.linear();
  return A;
}

SE3 interpolate(const SE3& a, const SE3& b, double ratio) {
  return a * se3_exp(ratio * se3_log(a.inverse() * b));
}

double yaw(const Eigen::Matrix3d& rotation) { return std::atan2(rotation(1, 0), rotation(0, 0)); }

}  // namespace saker::core
