#include "saker/slam/factors.h"

#include <Eigen/Cholesky>

namespace saker::slam {
namespace {

template <int Rows, int Columns>
using JacobianMap = Eigen::Map<Eigen::Matrix<double, Rows, Columns, Eigen::RowMajor>>;

/// W with Wᵀ W = Σ⁻¹: the inverse of Σ's lower Cholesky factor.
template <int N>
Eigen::Matrix<double, N, N> whitening(const Eigen::Matrix<double, N, N>& covariance) {
  Eigen::Matrix<double, N, N> W = Eigen::Matrix<double, N, N>::Identity();
  covariance.llt().matrixL().solveInPlace(W);
  return W;
}

}  // namespace

OdometryFactor::OdometryFactor(const SE3& T_a_b, const Matrix6d& covariance)
    : T_b_a_(T_a_b.inverse()), whitening_(whitening<6>(covariance)) {}

bool OdometryFactor::Evaluate(double const* const* parameters, double* residuals,
                              double** jacobians) const {
  const SE3 T_a_b = pose_from(parameters[0]).inverse() * pose_from(parameters[1]);
  const Vector6d error = core::se3_log(T_b_a_ * T_a_b);
  Eigen::Map<Vector6d>{residuals} = whitening_ * error;
  if (jacobians == nullptr) return true;
  const Matrix6d J = whitening_ * core::se3_right_jacobian_inverse(error);
  if (jacobians[0] != nullptr) {
    const Matrix6d moved = -J * core::se3_adjoint(T_a_b.inverse());
    JacobianMap<6, 7>{jacobians[0]} = moved * pose_lift(parameters[0]);
  }
  if (jacobians[1] != nullptr) JacobianMap<6, 7>{jacobians[1]} = J * pose_lift(parameters[1]);
  return true;
}

PoseFactor::PoseFactor(const SE3& T, const Matrix6d& covariance)
    : T_inverse_(T.inverse()), whitening_(whitening<6>(covariance)) {}

bool PoseFactor::Evaluate(double const* const* parameters, double* residuals,
                          double** jacobians) const {
  const Vector6d error = core::se3_log(T_inverse_ * pose_from(parameters[0]));
  Eigen::Map<Vector6d>{residuals} = whitening_ * error;
  if (jacobians != nullptr && jacobians[0] != nullptr) {
    JacobianMap<6, 7>{jacobians[0]} =
        whitening_ * core::se3_right_jacobian_inverse(error) * pose_lift(parameters[0]);
  }
  return true;
}

CuboidFactor::CuboidFactor(const objects::Cuboid& measured, const Matrix9d& covariance,
                           const HiddenEndConfig& hidden_ends)
    : T_measured_lidar_(measured.pose.inverse()),
      size_(measured.size),
      whitening_(whitening<9>(covariance)),
      hidden_ends_(measured, covariance, hidden_ends) {}

bool CuboidFactor::Evaluate(double const* const* parameters, double* residuals,
                            double** jacobians) const {
  const SE3 T_lidar_cuboid = pose_from(parameters[0]).inverse() * pose_from(parameters[1]);
  Vector9d error;
  error.head<6>() = core::se3_log(T_measured_lidar_ * T_lidar_cuboid);
  error.tail<3>() = Eigen::Map<const Eigen::Vector3d>(parameters[1] + kPoseParameters) - size_;
  const HiddenEnds::Softened softened = hidden_ends_(error);
  Eigen::Map<Vector9d>{residuals} = whitening_ * softened.error;
  if (jacobians == nullptr) return true;
  const Matrix9d slope = whitening_ * softened.slope;
  const Eigen::Matrix<double, 9, 6> J =
      slope.leftCols<6>() * core::se3_right_jacobian_inverse(error.head<6>());
  if (jacobians[0] != nullptr) {
    const Eigen::Matrix<double, 9, 6> moved = -J * core::se3_adjoint(T_lidar_cuboid.inverse());
    JacobianMap<9, 7>{jacobians[0]} = moved * pose_lift(parameters[0]);
  }
  if (jacobians[1] != nullptr) {
    JacobianMap<9, 10> object(jacobians[1]);
    object.leftCols<7>() = J * pose_lift(parameters[1]);
    object.rightCols<3>() = slope.rightCols<3>();
  }
  return true;
}

CylinderFactor::CylinderFactor(const objects::Cylinder& measured, const Matrix6d& covariance)
    : measured_(measured) {
  Eigen::Matrix<double, 6, 7> tangent = Eigen::Matrix<double, 6, 7>::Zero();
  tangent.topLeftCorner<3, 3>().setIdentity();
  tangent.block<2, 3>(3, 3) = objects::tangent_basis(measured.axis).transpose();
  tangent(5, 6) = 1;
  whitening_ = whitening<6>(covariance) * tangent;
}

bool CylinderFactor::Evaluate(double const* const* parameters, double* residuals,
                              double** jacobians) const {
  const SE3 T_lidar_world = pose_from(parameters[0]).inverse();
  const Eigen::Map<const Eigen::Vector3d> root(parameters[1]), axis(parameters[1] + 3);
  const Eigen::Vector3d root_lidar = T_lidar_world * root;
  const Eigen::Vector3d axis_lidar = T_lidar_world.linear() * axis;
  Eigen::Matrix<double, 7, 1> error;
  error.segment<3>(0) = root_lidar - measured_.root;
  error.segment<3>(3) = axis_lidar - measured_.axis;
  error[6] = parameters[1][6] - measured_.radius;
  Eigen::Map<Vector6d>{residuals} = whitening_ * error;
  if (jacobians == nullptr) return true;
  if (jacobians[0] != nullptr) {
    Eigen::Matrix<double, 7, 6> moved = Eigen::Matrix<double, 7, 6>::Zero();
    moved.block<3, 3>(0, 0) = core::hat(root_lidar);
    moved.block<3, 3>(0, 3) = -Eigen::Matrix3d::Identity();
    moved.block<3, 3>(3, 0) = core::hat(axis_lidar);
    JacobianMap<6, 7>{jacobians[0]} = whitening_ * moved * pose_lift(parameters[0]);
  }
  if (jacobians[1] != nullptr) {
    JacobianMap<6, 7> object(jacobians[1]);
    object.leftCols<3>() = whitening_.leftCols<3>() * T_lidar_world.linear();
    object.middleCols<3>(3) = whitening_.middleCols<3>(3) * T_lidar_world.linear();
    object.col(6) = whitening_.col(6);
  }
  return true;
}

std::unique_ptr<ceres::CostFunction> object_factor(const objects::Model& measured,
                                                   const Eigen::MatrixXd& covariance,
                                                   const HiddenEndConfig& hidden_ends) {
  if (const auto* cuboid = std::get_if<objects::Cuboid>(&measured)) {
    return std::make_unique<CuboidFactor>(*cuboid, covariance, hidden_ends);
  }
  return std::make_unique<CylinderFactor>(std::get<objects::Cylinder>(measured), covariance);
}

}  // namespace saker::slam
