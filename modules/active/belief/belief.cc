#include "saker/active/belief/belief.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

namespace saker::active {

using Eigen::Matrix4d;

namespace {

/// [x, y, length, width] of a box by how far out its front, rear, left and right face lie.
const Matrix4d kByFaces{{0.5, -0.5, 0, 0}, {0, 0, 0.5, -0.5}, {1, 1, 0, 0}, {0, 0, 1, 1}};

Matrix4d padded(const Covariance& covariance, double diagonal) {
  Matrix4d filled = diagonal * Matrix4d::Identity();
  filled.topLeftCorner(covariance.rows(), covariance.cols()) = covariance;
  return filled;
}

}  // namespace

Information information_of(const Measured& measured, double drift) {
  Matrix4d noise = padded(measured.covariance, 1);
  noise.diagonal().head<2>().array() += drift;
  Matrix4d of_object = noise.inverse();
  for (int i = static_cast<int>(measured.covariance.rows()); i < 4; ++i) of_object(i, i) = 0;
  const Matrix4d hidden = kByFaces * measured.hidden.asDiagonal();
  Information information;
  information.topLeftCorner<4, 4>() = of_object;
  information.topRightCorner<4, 4>() = of_object * hidden;
  information.bottomLeftCorner<4, 4>() = hidden.transpose() * of_object;
  information.bottomRightCorner<4, 4>() = hidden.transpose() * of_object * hidden;
  return information;
}

Belief::Belief(const Covariance& prior, const Covariance& common)
    : information_(Information::Identity()), common_(padded(common, 0)) {
  information_.topLeftCorner<4, 4>() = padded(prior, 1).inverse();
}

Belief Belief::known_to(const Covariance& covariance) const {
  Belief belief = *this;
  belief.information_.topLeftCorner<4, 4>() = padded(covariance, 1).inverse() + hidden_share();
  return belief;
}

/// That part of the object's information which goes into what hides its faces.
Matrix4d Belief::hidden_share() const {
  const Matrix4d both = information_.topRightCorner<4, 4>();
  return both * information_.bottomRightCorner<4, 4>().llt().solve(both.transpose());
}

/// Of the object alone: Schur's complement.
Matrix4d Belief::marginal() const { return information_.topLeftCorner<4, 4>() - hidden_share(); }

Matrix4d Belief::covariance() const { return marginal().inverse() + common_; }

/// ln det(A⁻¹ + K) = ln det(I + K A) − ln det A, without an inverse.
double Belief::entropy() const {
  const Matrix4d known = marginal();
  const Matrix4d spread = Matrix4d::Identity() + common_ * known;
  return 0.5 * std::log(spread.determinant() / known.determinant());
}

double Belief::most_gain(const Information& added) const {
  return 0.5 * std::log((information_ + added).determinant() / information_.determinant());
}

}  // namespace saker::active
