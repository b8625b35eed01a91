#include "saker/slam/manifolds.h"

#include <cmath>

namespace saker::slam {
namespace {

using ConstVector3 = Eigen::Map<const Eigen::Vector3d>;
using ConstQuaternion = Eigen::Map<const Eigen::Quaterniond>;

}  // namespace

SE3 pose_from(const double* parameters) {
  SE3 T = SE3::Identity();
  T.linear() = ConstQuaternion(parameters).normalized().toRotationMatrix();
  T.translation() = ConstVector3(parameters + 4);
  return T;
}

void write_pose(const SE3& T, double* parameters) {
  Eigen::Map<Eigen::Quaterniond>{parameters} = Eigen::Quaterniond(T.linear()).normalized();
  Eigen::Map<Eigen::Vector3d>{parameters + 4} = T.translation();
}

PoseLift pose_lift(const double* parameters) {
  const Eigen::Quaterniond q = ConstQuaternion(parameters).normalized();
  PoseLift J = PoseLift::Zero();
  J.block<3, 3>(0, 0) = 2 * (q.w() * Eigen::Matrix3d::Identity() - core::hat(q.vec()));
  J.block<3, 1>(0, 3) = -2 * q.vec();
  J.block<3, 3>(3, 4) = q.toRotationMatrix().transpose();
  return J;
}

Eigen::Vector3d axis_plus(const Eigen::Vector3d& axis, const Eigen::Vector2d& step) {
  const double angle = step.norm();
  const Eigen::Vector3d direction = objects::tangent_basis(axis) * step;
  const double sinc = angle < 1e-8 ? 1 : std::sin(angle) / angle;
  return (std::cos(angle) * axis + sinc * direction).normalized();
}

Eigen::Vector2d axis_minus(const Eigen::Vector3d& to, const Eigen::Vector3d& from) {
  const Eigen::Vector2d projected = objects::tangent_basis(from).transpose() * to;
  const double sine = projected.norm();
  const double angle = std::atan2(sine, to.dot(from));
  return sine < 1e-12 ? projected : Eigen::Vector2d(projected * (angle / sine));
}

bool PoseManifold::Plus(const double* x, const double* delta, double* x_plus_delta) const {
  const Eigen::Map<const Vector6d> step(delta);
  write_pose(pose_from(x) * core::se3_exp(step), x_plus_delta);
  return true;
}

bool PoseManifold::PlusJacobian(const double* x, double* jacobian) const {
  const ConstQuaternion q(x);
  Eigen::Map<Eigen::Matrix<double, kPoseParameters, kPoseTangent, Eigen::RowMajor>> J(jacobian);
  J.setZero();
  J.block<3, 3>(0, 0) = 0.5 * (q.w() * Eigen::Matrix3d::Identity() + core::hat(q.vec()));
  J.block<1, 3>(3, 0) = -0.5 * q.vec().transpose();
  J.block<3, 3>(4, 3) = q.toRotationMatrix();
  return true;
}

bool PoseManifold::Minus(const double* y, const double* x, double* y_minus_x) const {
  Eigen::Map<Vector6d> step(y_minus_x);
  step = core::se3_log(pose_from(x).inverse() * pose_from(y));
  return true;
}

bool PoseManifold::MinusJacobian(const double* x, double* jacobian) const {
  Eigen::Map<PoseLift> J(jacobian);
  J = pose_lift(x);
  return true;
}

bool AxisManifold::Plus(const double* x, const double* delta, double* x_plus_delta) const {
  Eigen::Map<Eigen::Vector3d> moved(x_plus_delta);
  moved = axis_plus(ConstVector3(x), Eigen::Map<const Eigen::Vector2d>(delta));
  return true;
}

bool AxisManifold::PlusJacobian(const double* x, double* jacobian) const {
  Eigen::Map<Eigen::Matrix<double, 3, 2, Eigen::RowMajor>> J(jacobian);
  J = objects::tangent_basis(ConstVector3(x));
  return true;
}

bool AxisManifold::Minus(const double* y, const double* x, double* y_minus_x) const {
  Eigen::Map<Eigen::Vector2d> step(y_minus_x);
  step = axis_minus(ConstVector3(y), ConstVector3(x));
  return true;
}

bool AxisManifold::MinusJacobian(const double* x, double* jacobian) const {
  Eigen::Map<Eigen::Matrix<double, 2, 3, Eigen::RowMajor>> J(jacobian);
  J = objects::tangent_basis(ConstVector3(x)).transpose();
  return true;
}

}  // namespace saker::slam
