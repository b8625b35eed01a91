#include "saker/core/se3.h"

#include <gtest/gtest.h>

#include <numbers>

#include "saker/core/rng.h"

namespace saker::core {
namespace {

Vector6d random_tangent(Rng& rng, double angle) {
  const Eigen::Vector3d axis(rng.normal(), rng.normal(), rng.normal());
  Vector6d tangent;
  tangent.head<3>() = angle * axis.normalized();
  tangent.tail<3>() = Eigen::Vector3d(rng.normal(0, 5), rng.normal(0, 5), rng.normal(0, 5));
  return tangent;
}

/// Generic, tiny and almost-π rotations.
class Se3Test : public testing::TestWithParam<double> {
 protected:
  Rng rng_{17};
};

TEST_P(Se3Test, LogInvertsExp) {
  for (int i = 0; i < 50; ++i) {
    const Vector6d tangent = random_tangent(rng_, GetParam());
    EXPECT_LT((se3_log(se3_exp(tangent)) - tangent).norm(), 1e-7);
  }
}

TEST_P(Se3Test, ExpInvertsLog) {
  for (int i = 0; i < 50; ++i) {
    const SE3 T = se3_exp(random_tangent(rng_, GetParam()));
    EXPECT_LT((se3_exp(se3_log(T)).matrix() - T.matrix()).norm(), 1e-9);
    EXPECT_LT((T.linear() * T.linear().transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
  }
}

TEST_P(Se3Test, RightJacobianInverseIsTheDerivativeOfLog) {
  const double step = 1e-6;
  for (int i = 0; i < 20; ++i) {
    const Vector6d tangent = random_tangent(rng_, GetParam());
    const SE3 T = se3_exp(tangent);
    Matrix6d numeric;
    for (int k = 0; k < 6; ++k) {
      const Vector6d delta = step * Vector6d::Unit(k);
      numeric.col(k) = (se3_log(T * se3_exp(delta)) - se3_log(T * se3_exp(-delta))) / (2 * step);
    }
    EXPECT_LT((se3_right_jacobian_inverse(tangent) - numeric).norm(), 1e-4 * (1 + numeric.norm()));
  }
}

TEST_P(Se3Test, AdjointMovesAPerturbationAcross) {
  for (int i = 0; i < 20; ++i) {
    const SE3 T = se3_exp(random_tangent(rng_, GetParam()));
    const Vector6d delta = 0.1 * random_tangent(rng_, 0.5);
    const SE3 left = T * se3_exp(delta) * T.inverse(), right = se3_exp(se3_adjoint(T) * delta);
    EXPECT_LT((left.matrix() - right.matrix()).norm(), 1e-9);
  }
}

TEST_P(Se3Test, InterpolationMeetsBothEndsAndHalvesTheWay) {
  const SE3 a = se3_exp(random_tangent(rng_, 1)), b = a * se3_exp(random_tangent(rng_, GetParam()));
  EXPECT_LT((interpolate(a, b, 0).matrix() - a.matrix()).norm(), 1e-9);
  EXPECT_LT((interpolate(a, b, 1).matrix() - b.matrix()).norm(), 1e-7);
  const SE3 half = interpolate(a, b, 0.5);
  EXPECT_LT(((half * (a.inverse() * half)).matrix() - b.matrix()).norm(), 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Angles, Se3Test,
                         testing::Values(0.0, 1e-9, 1e-5, 2e-4, 1e-3, 0.0099, 0.0101, 0.3, 1.5, 3.0,
                                         std::numbers::pi - 1e-4));

TEST(Se3, YawIsTheHeadingOfTheXAxis) {
  EXPECT_NEAR(yaw(so3_exp({0, 0, 2})), 2, 1e-12);
  EXPECT_NEAR(yaw(so3_exp({0, 0, -2})), -2, 1e-12);
}

}  // namespace
}  // namespace saker::core
