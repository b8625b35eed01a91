#include "saker/detection/cylinder_fit.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "made_scene.h"

namespace saker::detection {
namespace {

using Points = std::vector<Eigen::Vector3d>;

const Eigen::Vector3d kSensor(0, 0, 2);
const Eigen::Vector3d kRoot(7, 3, 0);

struct Trunk {
  double radius = 0.2;
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();
  double noise = 0.02;
  int points = 300;
  double height = 3;

  [[nodiscard]] Points seen(std::uint64_t seed) const {
    core::Rng rng(seed);
    const Eigen::Vector3d axis = Eigen::Vector3d(slope.x(), slope.y(), 1).normalized();
    return testing::visible_cylinder(kRoot, axis, radius, height, kSensor, points, noise, rng);
  }
};

CylinderFit fitted(const Points& points, const Eigen::Vector3d& sensor = kSensor) {
  const auto fit = fit_cylinder(points, sensor, {});
  EXPECT_TRUE(fit.has_value());
  CylinderFit none;
  none.covariance.setConstant(NAN);
  return fit.value_or(none);
}

TEST(CylinderFit, WithoutNoiseIsTheTruth) {
  for (const double radius : {0.05, 0.15, 0.4}) {
    for (const Eigen::Vector2d& slope : {Eigen::Vector2d(0, 0), Eigen::Vector2d(0.06, -0.04)}) {
      const CylinderFit fit = fitted(Trunk{radius, slope, 0}.seen(1));
      EXPECT_NEAR(fit.radius, radius, 0.003);
      EXPECT_LT((fit.foot - kRoot.head<2>()).norm(), 0.004) << radius;
      EXPECT_LT((fit.slope - slope).norm(), 0.003) << radius;
      EXPECT_LT(fit.residual, 0.003) << radius;
    }
  }
}

TEST(CylinderFit, ResidualIsTheNoiseOfThePoints) {
  EXPECT_NEAR(fitted(Trunk{.noise = 0.02}.seen(2)).residual, 0.02, 0.004);
}

TEST(CylinderFit, MovesWithTheScene) {
  Points points = Trunk{}.seen(3);
  const CylinderFit before = fitted(points);
  const Eigen::Vector3d shift(30, -20, 0);
  for (Eigen::Vector3d& p : points) p += shift;
  const CylinderFit after = fitted(points, kSensor + shift);
  EXPECT_LT((after.foot - before.foot - shift.head<2>()).norm(), 1e-8);
  EXPECT_LT((after.slope - before.slope).norm(), 1e-8);
  EXPECT_NEAR(after.radius, before.radius, 1e-8);
}

TEST(CylinderFit, TurnsWithTheScene) {
  const Points points = Trunk{.slope = {0.05, 0.02}}.seen(4);
  const CylinderFit before = fitted(points);
  for (const double angle : {0.6, 1.9, -2.5}) {
    const Eigen::Matrix3d R = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    Points turned = points;
    for (Eigen::Vector3d& p : turned) p = R * p;
    const CylinderFit after = fitted(turned, R * kSensor);
    EXPECT_LT((after.foot - R.topLeftCorner<2, 2>() * before.foot).norm(), 0.005) << angle;
    EXPECT_LT((after.slope - R.topLeftCorner<2, 2>() * before.slope).norm(), 0.005) << angle;
    EXPECT_NEAR(after.radius, before.radius, 0.005) << angle;
  }
}

TEST(CylinderFit, DoesNotDependOnTheOrderOfThePoints) {
  Points points = Trunk{}.seen(5);
  const CylinderFit before = fitted(points);
  std::ranges::reverse(points);
  EXPECT_NEAR(fitted(points).radius, before.radius, 1e-9);
  EXPECT_LT((fitted(points).foot - before.foot).norm(), 1e-9);
}

TEST(CylinderFit, AFewPointsFarOffMoveItLittle) {
  Points points = Trunk{}.seen(6);
  const CylinderFit before = fitted(points);
  for (int i = 0; i < 15; ++i) points.emplace_back(kRoot + Eigen::Vector3d(0.6, 0.5, 0.2 * i));
  EXPECT_LT((fitted(points).foot - before.foot).norm(), 0.03);
  EXPECT_NEAR(fitted(points).radius, before.radius, 0.03);
}

TEST(CylinderFit, CovarianceIsSymmetricAndPositive) {
  const auto P = fitted(Trunk{}.seen(7)).covariance;
  EXPECT_LT((P - P.transpose()).norm(), 1e-12);
  EXPECT_GT(P.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), 0);
}

TEST(CylinderFit, IsWorseKnownByNoisierPoints) {
  const CylinderFit clean = fitted(Trunk{.noise = 0.02}.seen(8));
  const CylinderFit noisy = fitted(Trunk{.noise = 0.06}.seen(8));
  for (int k = 0; k < 5; ++k) EXPECT_GT(noisy.covariance(k, k), clean.covariance(k, k)) << k;
}

TEST(CylinderFit, IsWorseKnownByFewerPointsButNotBetterByEverMore) {
  const auto variance = [](int points) {
    return fitted(Trunk{.points = points}.seen(9)).covariance(4, 4);
  };
  EXPECT_GT(variance(15), 1.5 * variance(60));
  EXPECT_NEAR(variance(3000) / variance(300), 1, 0.2);
}

TEST(CylinderFit, LeanOfAShortPieceIsHeldByItsPrior) {
  const CylinderFit shorter = fitted(Trunk{.points = 20, .height = 0.3}.seen(10));
  EXPECT_LT(shorter.slope.norm(), 0.15);
  const double lean_sd = CylinderFitConfig().lean_sd_deg * M_PI / 180;
  EXPECT_GT(std::sqrt(shorter.covariance(2, 2)), 0.7 * lean_sd);
  EXPECT_LT(std::sqrt(shorter.covariance(2, 2)), 1.01 * lean_sd);
}

TEST(CylinderFit, SaysHowWellItKnowsTheLean) {
  double squared = 0;
  constexpr int kRuns = 150;
  for (int run = 0; run < kRuns; ++run) {
    const CylinderFit fit = fitted(Trunk{.points = 50}.seen(100 + run));
    const Eigen::Matrix2d P = fit.covariance.block<2, 2>(2, 2);
    squared += fit.slope.dot(P.ldlt().solve(fit.slope)) / (2 * kRuns);
  }
  EXPECT_GT(squared, 0.3);
  EXPECT_LT(squared, 1.8);
}

TEST(CylinderFit, OfFewerThanThreePointsIsNone) {
  EXPECT_FALSE(fit_cylinder({}, kSensor, {}).has_value());
  EXPECT_FALSE(fit_cylinder({kRoot, kRoot}, kSensor, {}).has_value());
}

}  // namespace
}  // namespace saker::detection
