#pragma once

#include <ceres/manifold.h>
#include <ceres/product_manifold.h>

#include <Eigen/Core>

#include "saker/core/se3.h"
#include "saker/objects/models.h"

/// The graph's variables as Ceres sees them, and how they are perturbed.
///
///   pose      7: quaternion x y z w, translation;  tangent [rotation, translation], T ⊕ δ = T ·
///   exp(δ) cuboid   10: pose, size;                       tangent [rotation, translation, size]
///   cylinder  7: root, axis, radius;               tangent [root, axis in objects::tangent_basis,
///   radius]
namespace saker::slam {

constexpr int kPoseParameters = 7, kPoseTangent = 6;
constexpr int kCuboidParameters = 10, kCuboidTangent = 9;
constexpr int kCylinderParameters = 7, kCylinderTangent = 6;

using PoseLift = Eigen::Matrix<double, kPoseTangent, kPoseParameters, Eigen::RowMajor>;

[[nodiscard]] SE3 pose_from(const double* parameters);  ///< normalises the quaternion
void write_pose(const SE3& T, double* parameters);

/// d(y ⊖ x)/dy at y = x: takes a Jacobian in the tangent to one in the parameters.
[[nodiscard]] PoseLift pose_lift(const double* parameters);

/// The axis after a step in its tangent plane along the great circle, and the step between two
/// axes.
[[nodiscard]] Eigen::Vector3d axis_plus(const Eigen::Vector3d& axis, const Eigen::Vector2d& step);
[[nodiscard]] Eigen::Vector2d axis_minus(const Eigen::Vector3d& to, const Eigen::Vector3d& from);

class PoseManifold final : public ceres::Manifold {
 public:
  [[nodiscard]] int AmbientSize() const override { return kPoseParameters; }
  [[nodiscard]] int TangentSize() const override { return kPoseTangent; }
  bool Plus(const double* x, const double* delta, double* x_plus_delta) const override;
  bool PlusJacobian(const double* x, double* jacobian) const override;
  bool Minus(const double* y, const double* x, double* y_minus_x) const override;
  bool MinusJacobian(const double* x, double* jacobian) const override;
};

class AxisManifold final : public ceres::Manifold {
 public:
  [[nodiscard]] int AmbientSize() const override { return 3; }
  [[nodiscard]] int TangentSize() const override { return 2; }
  bool Plus(const double* x, const double* delta, double* x_plus_delta) const override;
  bool PlusJacobian(const double* x, double* jacobian) const override;
  bool Minus(const double* y, const double* x, double* y_minus_x) const override;
  bool MinusJacobian(const double* x, double* jacobian) const override;
};

using CuboidManifold = ceres::ProductManifold<PoseManifold, ceres::EuclideanManifold<3>>;
using CylinderManifold =
    ceres::ProductManifold<ceres::EuclideanManifold<3>, AxisManifold, ceres::EuclideanManifold<1>>;

}  // namespace saker::slam
