#pragma once

#include <ceres/sized_cost_function.h>

#include <memory>

#include "saker/slam/hidden_ends.h"
#include "saker/slam/manifolds.h"

/// The paper's factors with analytic Jacobians, each residual whitened by its measurement's
/// covariance: ½ |W e|² with Wᵀ W = Σ⁻¹.
namespace saker::slam {

/// e = log(Z⁻¹ · T_a⁻¹ · T_b): the odometry factor between two poses, Z the measured T_a_b, Σ its
/// right tangent's.
class OdometryFactor final
    : public ceres::SizedCostFunction<kPoseTangent, kPoseParameters, kPoseParameters> {
 public:
  OdometryFactor(const SE3& T_a_b, const Matrix6d& covariance);
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  SE3 T_b_a_;
  Matrix6d whitening_;
};

/// e = log(Z⁻¹ · T): what is known of a pose beforehand, Σ its right tangent's.
class PoseFactor final : public ceres::SizedCostFunction<kPoseTangent, kPoseParameters> {
 public:
  PoseFactor(const SE3& T, const Matrix6d& covariance);
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  SE3 T_inverse_;
  Matrix6d whitening_;
};

/// Equation 1: e = [log(H(z)⁻¹ · T_lidar_world · T_world_cuboid), d − d(z)], Σ in the measured
/// cuboid's own frame.
///
/// Its ends may have been hidden (hidden_ends.h): with many `sds` it is the paper's
/// equation.
class CuboidFactor final
    : public ceres::SizedCostFunction<kCuboidTangent, kPoseParameters, kCuboidParameters> {
 public:
  CuboidFactor(const objects::Cuboid& measured, const Matrix9d& covariance,
               const HiddenEndConfig& hidden_ends);
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  SE3 T_measured_lidar_;
  Eigen::Vector3d size_;
  Matrix9d whitening_;
  HiddenEnds hidden_ends_;
};

/// Equation 2: e = [R b + t − b(z), R n − n(z), r − r(z)], seven rows. Σ is that of the
/// six-dimensional tangent, so the axis rows are weighted through the tangent plane at n(z); along
/// n(z) an axis has no error to weigh.
class CylinderFactor final
    : public ceres::SizedCostFunction<kCylinderTangent, kPoseParameters, kCylinderParameters> {
 public:
  CylinderFactor(const objects::Cylinder& measured, const Matrix6d& covariance);
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  objects::Cylinder measured_;
  Eigen::Matrix<double, 6, 7> whitening_;
};

/// The factor between a lidar pose and the object that was measured from it.
[[nodiscard]] std::unique_ptr<ceres::CostFunction> object_factor(
    const objects::Model& measured, const Eigen::MatrixXd& covariance,
    const HiddenEndConfig& hidden_ends);

}  // namespace saker::slam
