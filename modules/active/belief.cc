#include "active/belief.h"

#include <Eigen/LU>
#include <cmath>

namespace saker::active {

using Eigen::Matrix4d;

namespace {

Matrix4d padded(const Covariance& covariance, double diagonal) {
  Matrix4d filled = diagonal * Matrix4d::Identity();
  filled.topLeftCorner(covariance.rows(), covariance.cols()) = covariance;
  return filled;
}

}  // namespace

Matrix4d information_of(const Covariance& covariance, double drift) {
  Matrix4d noise = padded(covariance, 1);
  noise.diagonal().head<2>().array() += drift;
  Matrix4d information = noise.inverse();
  for (int i = static_cast<int>(covariance.rows()); i < 4; ++i) information(i, i) = 0;
  return information;
}

Belief::Belief(const Covariance& prior, const Covariance& common)
    : information_(padded(prior, 1).inverse()), common_(padded(common, 0)) {}

Matrix4d Belief::covariance() const { return information_.inverse() + common_; }

/// ln det(A⁻¹ + K) = ln det(I + K A) − ln det A, without an inverse.
double Belief::entropy() const {
  const Matrix4d spread = Matrix4d::Identity() + common_ * information_;
  return 0.5 * std::log(spread.determinant() / information_.determinant());
}

double Belief::most_gain(const Matrix4d& added) const {
  return 0.5 * std::log((information_ + added).determinant() / information_.determinant());
}

}  // namespace saker::active
