#include "saker/uncertainty/geometric.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

namespace saker::uncertainty {
namespace {

constexpr double kLeastWhole = 0.01;  // a spline may overshoot

/// Lower triangle of the Cholesky factor by rows, its diagonal as logarithm: any values of it are a
/// positive definite matrix.
Eigen::VectorXd log_cholesky(const Eigen::MatrixXd& covariance) {
  const Eigen::MatrixXd factor = covariance.llt().matrixL();
  const Eigen::Index n = factor.rows();
  Eigen::VectorXd packed(n * (n + 1) / 2);
  for (Eigen::Index i = 0, at = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j) {
      packed[at++] = i == j ? std::log(factor(i, i)) : factor(i, j);
    }
  }
  return packed;
}

Eigen::MatrixXd from_log_cholesky(const Eigen::VectorXd& packed, Eigen::Index n) {
  Eigen::MatrixXd factor = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0, at = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j, ++at) {
      factor(i, j) = i == j ? std::exp(packed[at]) : packed[at];
    }
  }
  return factor * factor.transpose();
}

/// Bias, log-Cholesky factor, share of whole measurements, means of the covariates.
Eigen::VectorXd packed(const GeometricModel::Interval& interval) {
  const Eigen::VectorXd factor = log_cholesky(interval.covariance);
  Eigen::VectorXd all(interval.bias.size() + factor.size() + 1 + interval.covariate_mean.size());
  all << interval.bias, factor, interval.whole, interval.covariate_mean;
  return all;
}

Eigen::VectorXd packed_parity(const Eigen::VectorXd& parity, Eigen::Index covariates) {
  const Eigen::Index n = parity.size();
  Eigen::VectorXd all = Eigen::VectorXd::Ones(n + n * (n + 1) / 2 + 1 + covariates);
  all.head(n) = parity;
  for (Eigen::Index i = 0, at = n; i < n; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j) all[at++] = parity[i] * parity[j];
  }
  return all;
}

SplineSurface surface_of(const GeometricModel::Parts& parts) {
  std::vector<Eigen::VectorXd> nodes;
  for (const GeometricModel::Interval& interval : parts.fitted) nodes.push_back(packed(interval));
  const Eigen::VectorXd parity = mirror(parts.common.rows(), parts.intervals.sectors);
  const auto covariates = static_cast<Eigen::Index>(parts.slopes.size());
  return {parts.intervals, std::move(nodes), packed_parity(parity, covariates)};
}

}  // namespace

Eigen::VectorXd mirror(Eigen::Index dimension, int sectors) {
  Eigen::VectorXd parity = Eigen::VectorXd::Ones(dimension);
  if (sectors > 1) parity[1] = -1;
  return parity;
}

Eigen::VectorXd reach_of_slope(const Eigen::VectorXd& parity, double angle) {
  const double sine = std::sin(std::abs(angle));
  return parity.unaryExpr([&](double p) { return p < 0 ? sine : 1.0; });
}

GeometricModel::GeometricModel(Parts parts)
    : parts_(std::move(parts)), surface_(surface_of(parts_)) {}

GeometricModel::Expected GeometricModel::expected(const View& view) const {
  const Eigen::Index n = parts_.common.rows(), triangle = n * (n + 1) / 2;
  const Eigen::VectorXd values = surface_.at(view.range, std::abs(view.angle));
  const Eigen::VectorXd parity = mirror(n, parts_.intervals.sectors);
  Expected expected{values.head(n), from_log_cholesky(values.segment(n, triangle), n),
                    std::clamp(values[n + triangle], kLeastWhole, 1.0), false};
  for (std::size_t i = 0; i < parts_.slopes.size(); ++i) {
    const Slope& slope = parts_.slopes[i];
    const double mean = values[n + triangle + 1 + static_cast<Eigen::Index>(i)];
    const double z = standardised(value_of(view, slope.covariate), mean, slope.spread);
    expected.bias += z * slope.bias.cwiseProduct(reach_of_slope(parity, view.angle));
    expected.covariance *= std::exp(slope.log_scale * z);
  }
  if (parts_.intervals.mirrored(view)) {
    expected.bias = expected.bias.cwiseProduct(parity);
    expected.covariance = parity.asDiagonal() * expected.covariance * parity.asDiagonal();
  }
  const auto& interval = parts_.fitted[static_cast<std::size_t>(parts_.intervals.of(view))];
  expected.extrapolated = interval.objects == 0 || !parts_.intervals.contains(view.range);
  return expected;
}

}  // namespace saker::uncertainty
