#include "core/se3.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace saker::core {
namespace {

/// Steps of every size that matters: none, tiny (series), at the switch from series to closed form,
/// generic, almost π.
std::vector<Vector6d> steps() {
  const Eigen::Vector3d axis = Eigen::Vector3d(0.3, -0.7, 0.5).normalized();
  const Eigen::Vector3d translation(1.5, -2, 0.7);
  std::vector<Vector6d> all;
  for (const double angle : {0.0, 1e-12, 1e-8, 0.9e-4, 1.1e-4, 0.9e-2, 1.1e-2, 0.3, 1.7, 3.0,
                             std::numbers::pi - 1e-3, std::numbers::pi - 1e-6}) {
    for (const double length : {0.0, 1e-9, 1.0}) {
      all.emplace_back();
      all.back().head<3>() = angle * axis;
      all.back().tail<3>() = length * translation;
    }
  }
  return all;
}

SE3 some_pose() { return se3_exp((Vector6d() << 0.4, 1.1, -0.9, 3, -7, 2).finished()); }

TEST(Se3, NoStepGoesNowhere) {
  const SE3 T = some_pose();
  EXPECT_TRUE((T * se3_exp(Vector6d::Zero())).isApprox(T, 1e-15));
  EXPECT_EQ(se3_log(SE3::Identity()).norm(), 0);
}

TEST(Se3, DifferenceUndoesStep) {
  const SE3 T = some_pose();
  for (const Vector6d& step : steps()) {
    const Vector6d back = se3_log(T.inverse() * (T * se3_exp(step)));
    EXPECT_LT((back - step).norm(), 1e-8) << step.transpose();
  }
}

TEST(Se3, ExponentialIsARotationAndAgreesWithTheMatrixSeries) {
  for (const Vector6d& step : steps()) {
    Eigen::Matrix4d twist = Eigen::Matrix4d::Zero(), term = Eigen::Matrix4d::Identity();
    twist.topLeftCorner<3, 3>() = hat(step.head<3>());
    twist.topRightCorner<3, 1>() = step.tail<3>();
    Eigen::Matrix4d sum = term;
    for (int n = 1; n < 40; ++n) sum += term = (term * twist / n).eval();
    EXPECT_LT((se3_exp(step).matrix() - sum).norm(), 1e-12) << step.transpose();
  }
}

TEST(Se3, LogOfRotationStaysWithinPi) {
  const Eigen::Vector3d axis = Eigen::Vector3d(1, 2, -1).normalized();
  for (const double angle : {3.0, std::numbers::pi, 3.3, 6.0}) {
    const Eigen::Vector3d log = so3_log(so3_exp(angle * axis));
    EXPECT_LE(log.norm(), std::numbers::pi + 1e-9);
    EXPECT_LT((so3_exp(log) - so3_exp(angle * axis)).norm(), 1e-9);
  }
}

/// d log(T · exp(δ)) / dδ by central differences.
Matrix6d numeric_jacobian(const SE3& T, double h) {
  Matrix6d J;
  for (int i = 0; i < 6; ++i) {
    const Vector6d step = h * Vector6d::Unit(i);
    J.col(i) = (se3_log(T * se3_exp(step)) - se3_log(T * se3_exp(-step))) / (2 * h);
  }
  return J;
}

TEST(Se3, RightJacobianInverseIsTheDerivativeOfTheLog) {
  for (const Vector6d& step : steps()) {
    if (step.head<3>().norm() > std::numbers::pi - 1e-2) continue;  // differences would step over π
    const Matrix6d expected = numeric_jacobian(se3_exp(step), 1e-5);
    const Matrix6d actual = se3_right_jacobian_inverse(step);
    EXPECT_LT((actual - expected).norm(), 1e-6 * expected.norm()) << step.transpose();
  }
}

TEST(Se3, RightJacobianInverseIsFiniteAtAlmostPi) {
  for (const Vector6d& step : steps()) EXPECT_TRUE(se3_right_jacobian_inverse(step).allFinite());
}

TEST(Se3, AdjointMovesAStepToTheLeft) {
  const SE3 T = some_pose();
  for (const Vector6d& step : steps()) {
    const SE3 right = T * se3_exp(step) * T.inverse();
    EXPECT_LT((se3_exp(se3_adjoint(T) * step).matrix() - right.matrix()).norm(), 1e-10);
  }
}

TEST(Se3, InterpolationKeepsTheEndsAndHalvesTheWay) {
  const SE3 a = some_pose(), b = a * se3_exp(steps()[25]);
  EXPECT_TRUE(interpolate(a, b, 0).isApprox(a, 1e-12));
  EXPECT_TRUE(interpolate(a, b, 1).isApprox(b, 1e-10));
  const SE3 middle = interpolate(a, b, 0.5);
  EXPECT_TRUE((a.inverse() * middle).isApprox(middle.inverse() * b, 1e-10));
}

TEST(Se3, YawIsTheHeadingOfTheXAxis) {
  EXPECT_NEAR(yaw(so3_exp({0, 0, 2.5})), 2.5, 1e-12);
  EXPECT_NEAR(yaw(so3_exp({0, 0, -3})), -3, 1e-12);
}

}  // namespace
}  // namespace saker::core
