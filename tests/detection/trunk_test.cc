#include "saker/detection/trunk.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "made_scene.h"

namespace saker::detection {
namespace {

using testing::visible_cylinder;

const Eigen::Vector3d kSensor(0, 0, 3);

TEST(Trunk, IsFoundWithRootAxisAndRadius) {
  const Eigen::Vector3d axis = Eigen::Vector3d(0.08, -0.05, 1).normalized();
  for (const double radius : {0.08, 0.15, 0.3}) {
    core::Rng rng(7);
    const auto fit = fit_trunk(
        visible_cylinder({8, 3, 0}, axis, radius, 3, kSensor, 200, 0.02, rng), kSensor, {});
    ASSERT_EQ(fit.status, TrunkStatus::fitted) << radius;
    EXPECT_NEAR(fit.cylinder.radius, radius, 0.03);
    EXPECT_NEAR((fit.cylinder.root - Eigen::Vector3d(8, 3, 0)).norm(), 0, 0.05);
    EXPECT_GT(fit.cylinder.axis.dot(axis), std::cos(0.03));
  }
}

TEST(Trunk, SaysHowWellItKnowsItsFootAndRadius) {
  double foot = 0;
  double radius = 0;
  constexpr int kRuns = 200;
  for (int run = 0; run < kRuns; ++run) {
    core::Rng rng(run);
    const auto fit = fit_trunk(
        visible_cylinder({8, 3, 0}, {0, 0, 1}, 0.15, 3, kSensor, 60, 0.02, rng), kSensor, {});
    ASSERT_EQ(fit.status, TrunkStatus::fitted);
    const Eigen::Vector2d error = fit.cylinder.root.head<2>() - Eigen::Vector2d(8, 3);
    foot += error.dot(fit.covariance.topLeftCorner<2, 2>().ldlt().solve(error)) / (2 * kRuns);
    radius += std::pow(fit.cylinder.radius - 0.15, 2) / fit.covariance(5, 5) / kRuns;
  }
  EXPECT_GT(foot, 0.05);
  EXPECT_LT(foot, 2);
  EXPECT_GT(radius, 0.1);
  EXPECT_LT(radius, 2.5);
}

TEST(Trunk, IsRefusedWhereItCannotBeOne) {
  core::Rng rng(3);
  const auto status = [&](const std::vector<Eigen::Vector3d>& points) {
    return fit_trunk(points, kSensor, {}).status;
  };
  auto floating = visible_cylinder({8, 3, 2}, {0, 0, 1}, 0.15, 3, kSensor, 100, 0.02, rng);
  EXPECT_EQ(status(floating), TrunkStatus::floats);
  EXPECT_EQ(status(visible_cylinder({8, 3, 0}, {0, 0, 1}, 0.15, 0.8, kSensor, 100, 0.02, rng)),
            TrunkStatus::too_short);
  EXPECT_EQ(status(visible_cylinder({8, 3, 0}, {0, 0, 1}, 1.5, 3, kSensor, 300, 0.02, rng)),
            TrunkStatus::no_cylinder);
  EXPECT_EQ(status({}), TrunkStatus::too_few);
}

TEST(Trunk, CovarianceTurnsWithTheFrame) {
  const Eigen::Vector3d axis = Eigen::Vector3d(0.1, 0.2, 1).normalized();
  const Eigen::Matrix3d R =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(0.1, 0, 1).normalized()).toRotationMatrix();
  Matrix6d P = Matrix6d::Identity();
  P(0, 3) = P(3, 0) = 0.3;
  const Matrix6d back = rotated(rotated(P, R, axis), R.transpose(), R * axis);
  EXPECT_LT((back - P).norm(), 1e-9);
}

}  // namespace
}  // namespace saker::detection
