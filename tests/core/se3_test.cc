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

TEST_P(Se3Test, TheOppositeTangentIsTheInverse) {
  for (int i = 0; i < 20; ++i) {
    const Vector6d tangent = random_tangent(rng_, GetParam());
    const SE3 there_and_back = se3_exp(tangent) * se3_exp(-tangent);
    EXPECT_LT((there_and_back.matrix() - SE3::Identity().matrix()).norm(), 1e-9);
  }
}

TEST_P(Se3Test, HalfATangentTwiceIsTheWhole) {
  for (int i = 0; i < 20; ++i) {
    const Vector6d tangent = random_tangent(rng_, GetParam());
    const SE3 half = se3_exp(0.5 * tangent);
    EXPECT_LT(((half * half).matrix() - se3_exp(tangent).matrix()).norm(), 1e-9);
  }
}

TEST_P(Se3Test, AdjointOfAProductIsTheProductOfAdjoints) {
  const SE3 a = se3_exp(random_tangent(rng_, GetParam())), b = se3_exp(random_tangent(rng_, 1));
  EXPECT_LT((se3_adjoint(a * b) - se3_adjoint(a) * se3_adjoint(b)).norm(), 1e-9);
  EXPECT_LT((se3_adjoint(a.inverse()) - se3_adjoint(a).inverse()).norm(), 1e-9);
}

TEST(Se3, HatIsTheCrossProduct) {
  const Eigen::Vector3d a(1, -2, 3), b(0.5, 4, -1);
  EXPECT_LT((hat(a) * b - a.cross(b)).norm(), 1e-12);
  EXPECT_TRUE(hat(a).transpose().isApprox(-hat(a)));
}

TEST(Se3, AQuarterOfACircleIsDrivenByItsArc) {
  Vector6d tangent;
  tangent << 0, 0, M_PI / 2, M_PI / 2, 0, 0;  // a radius of 1 m
  const SE3 T = se3_exp(tangent);
  EXPECT_LT((T.translation() - Eigen::Vector3d(1, 1, 0)).norm(), 1e-12);
  EXPECT_NEAR(yaw(T.linear()), M_PI / 2, 1e-12);
}

TEST(Se3, LogTakesTheShorterWayRound) {
  for (double angle = -7; angle <= 7; angle += 0.37) {
    const double found = so3_log(so3_exp({0, 0, angle})).z();
    EXPECT_NEAR(std::remainder(found - angle, 2 * M_PI), 0, 1e-9) << angle;
    EXPECT_LE(std::abs(found), M_PI + 1e-9) << angle;
  }
}

TEST(Se3, InterpolationAtQuartersIsEven) {
  Rng rng(4);
  const SE3 a = se3_exp(random_tangent(rng, 1)), b = se3_exp(random_tangent(rng, 2));
  const Vector6d step = se3_log(interpolate(a, b, 0).inverse() * interpolate(a, b, 0.25));
  for (const double ratio : {0.25, 0.5, 0.75}) {
    const SE3 next = interpolate(a, b, ratio).inverse() * interpolate(a, b, ratio + 0.25);
    EXPECT_LT((se3_log(next) - step).norm(), 1e-9) << ratio;
  }
}

TEST(Se3, YawDoesNotFeelRollAndPitch) {
  const Eigen::Matrix3d tilt = so3_exp({0, 0.3, 0}) * so3_exp({-0.4, 0, 0});
  for (const double heading : {-2.0, 0.1, 3.0}) {
    EXPECT_NEAR(yaw(so3_exp({0, 0, heading}) * tilt), heading, 1e-12);
  }
}

}  // namespace
}  // namespace saker::core
