#pragma once

#include <Eigen/Geometry>

/// Rigid motions. Tangents are [rotation, translation], perturbations act on the right: T ⊕ δ = T ·
/// exp(δ).
namespace saker {

using SE3 = Eigen::Isometry3d;
using Vector6d = Eigen::Matrix<double, 6, 1>;
using Vector9d = Eigen::Matrix<double, 9, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Matrix9d = Eigen::Matrix<double, 9, 9>;

namespace core {

[[nodiscard]] Eigen::Matrix3d hat(const Eigen::Vector3d& v);

[[nodiscard]] Eigen::Matrix3d so3_exp(const Eigen::Vector3d& rotation);
[[nodiscard]] Eigen::Vector3d so3_log(const Eigen::Matrix3d& rotation);  ///< norm in [0, π]

[[nodiscard]] SE3 se3_exp(const Vector6d& tangent);
[[nodiscard]] Vector6d se3_log(const SE3& T);

/// Inverse of the right Jacobian: d log(T · exp(δ)) / dδ at δ = 0, at tangent = log(T).
/// Barfoot, "State Estimation for Robotics", eq. 7.95 (left form), in our order of the tangent.
[[nodiscard]] Matrix6d se3_right_jacobian_inverse(const Vector6d& tangent);

/// Adjoint: T · exp(δ) · T⁻¹ = exp(Ad(T) δ).
[[nodiscard]] Matrix6d se3_adjoint(const SE3& T);

/// The motion at `ratio` (0 … 1) of the way from a to b along the geodesic.
[[nodiscard]] SE3 interpolate(const SE3& a, const SE3& b, double ratio);

/// Heading of the x axis about z, radians in (−π, π].
[[nodiscard]] double yaw(const Eigen::Matrix3d& rotation);

}  // namespace core
}  // namespace saker
