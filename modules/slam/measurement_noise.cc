#include "saker/slam/measurement_noise.h"

#include <cmath>
#include <numbers>

namespace saker::slam {
namespace {

/// How [root, axis, radius] moves when the axis turns about the middle of the part that was seen.
Eigen::Matrix<double, 6, 2> lean_of(const objects::Cylinder& cylinder) {
  Eigen::Matrix<double, 6, 2> J = Eigen::Matrix<double, 6, 2>::Zero();
  J.block<3, 2>(0, 0) = -0.5 * cylinder.height * objects::tangent_basis(cylinder.axis);
  J.block<2, 2>(3, 0).setIdentity();
  return J;
}

/// How [rotation, translation, size] moves when the top rises and the bottom stays.
Vector9d roof() {
  Vector9d J = Vector9d::Zero();
  J[5] = 0.5;
  J[8] = 1;
  return J;
}

}  // namespace

Gaussian with_common_errors(const Gaussian& measured, const MeasurementNoiseConfig& config,
                            bool fitted) {
  Gaussian result = measured;
  if (!fitted) result.covariance *= config.covariance_scale;
  if (is_cuboid(measured.model)) {
    const Vector9d J = config.roof_m * roof();
    result.covariance += J * J.transpose();
  } else {
    const double lean = config.lean_deg * std::numbers::pi / 180;
    auto J = (lean * lean_of(std::get<objects::Cylinder>(measured.model))).eval();
    if (fitted) J.topRows<3>().setZero();
    result.covariance += J * J.transpose();
  }
  return result;
}

Eigen::VectorXd common_variances(const Model& model, const MeasurementNoiseConfig& config) {
  Eigen::VectorXd sd = Eigen::VectorXd::Zero(is_cuboid(model) ? 9 : 6);
  if (is_cuboid(model)) {
    sd.segment<2>(3).setConstant(config.common_place_m);
    sd.segment<2>(6) << config.common_length_m, config.common_width_m;
  } else {
    const double radius = std::get<objects::Cylinder>(model).radius;
    sd.head<2>().setConstant(config.common_root * radius);
    sd[5] = std::hypot(config.common_radius_m, config.common_taper * radius);
  }
  return sd.cwiseAbs2();
}

Eigen::MatrixXd with_class_width(const Eigen::MatrixXd& covariance, double sd) {
  constexpr Eigen::Index kWidth = 7;
  const Eigen::VectorXd of_width = covariance.col(kWidth);
  return covariance - of_width * of_width.transpose() / (of_width[kWidth] + sd * sd);
}

Eigen::MatrixXd widened(const Model& model, const Eigen::MatrixXd& covariance,
                        const MeasurementNoiseConfig& config) {
  Eigen::VectorXd windows = Eigen::VectorXd::Ones(covariance.rows());
  if (is_cuboid(model)) {
    windows.segment<2>(3).setConstant(config.shared_place);
    windows.segment<2>(6) << config.shared_length, config.shared_width;
  } else {
    windows.head<2>().setConstant(config.shared_root);
    windows[5] = config.shared_radius;
  }
  const Eigen::VectorXd sd = windows.cwiseSqrt();
  return sd.asDiagonal() * covariance * sd.asDiagonal();
}

}  // namespace saker::slam
