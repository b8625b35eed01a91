#include "saker/detection/trunk.h"

#include <algorithm>
#include <cmath>

namespace saker::detection {
namespace {

TrunkStatus judge(const CylinderFit& fit, const TrunkConfig& config) {
  if (fit.slope.norm() > std::tan(config.most_lean_deg * M_PI / 180)) return TrunkStatus::leans;
  const bool cylinder = fit.radius >= config.least_radius_m && fit.radius <= config.most_radius_m &&
                        fit.residual <= config.most_residual_m;
  return cylinder ? TrunkStatus::fitted : TrunkStatus::no_cylinder;
}

/// From [foot, slope, radius] to [root, axis, radius].
Matrix6d covariance_of(const CylinderFit& fit, const Eigen::Vector3d& axis,
                       const TrunkConfig& config) {
  Eigen::Matrix<double, 6, 5> J = Eigen::Matrix<double, 6, 5>::Zero();
  J.block<2, 2>(0, 0).setIdentity();
  const double length = std::sqrt(1 + fit.slope.squaredNorm());
  const Eigen::Matrix3d normalise =
      (Eigen::Matrix3d::Identity() - axis * axis.transpose()) / length;
  J.block<2, 2>(3, 2) = objects::tangent_basis(axis).transpose() * normalise.leftCols<2>();
  J(5, 4) = 1;
  Matrix6d P = J * fit.covariance * J.transpose();
  // The ground's height slides the root along the axis.
  P.topLeftCorner<3, 3>() += std::pow(config.ground_m * length, 2) * axis * axis.transpose();
  P(0, 0) += config.pose_m * config.pose_m;
  P(1, 1) += config.pose_m * config.pose_m;
  return P;
}

}  // namespace

TrunkFit fit_trunk(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& sensor,
                   const TrunkConfig& config) {
  TrunkFit result;
  if (static_cast<int>(points.size()) < config.least_points) return result;
  const auto lower = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return a.z() < b.z();
  };
  const auto [lowest, highest] = std::minmax_element(points.begin(), points.end(), lower);
  result.status = TrunkStatus::too_short;
  if (highest->z() - lowest->z() < config.least_height_m) return result;
  result.status = TrunkStatus::floats;
  if (lowest->z() > config.most_gap_m) return result;
  result.status = TrunkStatus::no_cylinder;
  const auto fit = fit_cylinder(points, sensor, config.fit);
  if (!fit) return result;
  result.status = judge(*fit, config);
  const Eigen::Vector3d axis = Eigen::Vector3d(fit->slope.x(), fit->slope.y(), 1).normalized();
  result.cylinder.root = {fit->foot.x(), fit->foot.y(), 0};
  result.cylinder.axis = axis;
  result.cylinder.radius = fit->radius;
  result.cylinder.height = highest->z() / axis.z();
  if (result.status == TrunkStatus::fitted &&
      result.cylinder.height < 2 * config.least_slenderness * fit->radius)
    result.status = TrunkStatus::no_cylinder;
  result.covariance = covariance_of(*fit, axis, config);
  return result;
}

Matrix6d rotated(const Matrix6d& covariance, const Eigen::Matrix3d& R_b_a,
                 const Eigen::Vector3d& axis_in_a) {
  Matrix6d J = Matrix6d::Zero();
  J.topLeftCorner<3, 3>() = R_b_a;
  J.block<2, 2>(3, 3) = objects::tangent_basis(R_b_a * axis_in_a).transpose() * R_b_a *
                        objects::tangent_basis(axis_in_a);
  J(5, 5) = 1;
  return J * covariance * J.transpose();
}

}  // namespace saker::detection
