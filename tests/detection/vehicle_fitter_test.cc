#include "saker/detection/vehicle_fitter.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "saker/core/rng.h"

namespace saker::detection {
namespace {

TEST(Upright, BoxHasThePlansCornersInItsAxes) {
  for (const double direction : {0.0, 0.7, -2.3}) {
    const Eigen::Vector2d low(3, -1), high(7.5, 0.8);
    const objects::Cuboid box = upright(direction, {low, high}, {0.2, 1.6});
    EXPECT_TRUE(box.size.isApprox(Eigen::Vector3d(4.5, 1.8, 1.4), 1e-12));
    const Eigen::Vector3d corner = box.pose * Eigen::Vector3d(-0.5 * box.size);
    const Eigen::Vector2d expected = Eigen::Rotation2Dd(direction) * low;
    EXPECT_LT((corner - Eigen::Vector3d(expected.x(), expected.y(), 0.2)).norm(), 1e-12);
  }
}

TEST(Upright, BoxStandsUpright) {
  EXPECT_TRUE(upright(1.1, {Eigen::Vector2d(0, 0), {1, 1}}, {0, 1})
                  .pose.linear()
                  .col(2)
                  .isApprox(Eigen::Vector3d::UnitZ(), 1e-12));
}

TEST(CentreAndSize, OfIndependentEdgesAreIndependent) {
  const Eigen::Matrix2d P = of_centre_and_size(0.01 * Eigen::Matrix2d::Identity());
  EXPECT_NEAR(P(0, 0), 0.005, 1e-12);
  EXPECT_NEAR(P(1, 1), 0.02, 1e-12);
  EXPECT_NEAR(P(0, 1), 0, 1e-12);
}

TEST(CentreAndSize, OfEdgesThatErrTogetherAreAKnownSizeAtAnUnknownPlace) {
  const Eigen::Matrix2d P = of_centre_and_size(0.01 * Eigen::Matrix2d::Ones());
  EXPECT_NEAR(P(0, 0), 0.01, 1e-12);
  EXPECT_NEAR(P(1, 1), 0, 1e-12);
}

TEST(CentreAndSize, HaveTheCovarianceOfManyDraws) {
  Eigen::Matrix2d edges;
  edges << 0.04, 0.01, 0.01, 0.09;
  const Eigen::Matrix2d factor = edges.llt().matrixL();
  core::Rng rng(1);
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
  constexpr int kDraws = 40000;
  for (int i = 0; i < kDraws; ++i) {
    const Eigen::Vector2d off = factor * Eigen::Vector2d(rng.normal(), rng.normal());
    const Extent extent{off[0], off[1]};
    const Eigen::Vector2d both(extent.centre(), extent.size());
    sum += both * both.transpose() / kDraws;
  }
  EXPECT_LT((sum - of_centre_and_size(edges)).norm(), 0.004);
}

TEST(NearestRange, IsTheHorizontalDistanceOfTheNearerSensor) {
  const Beams beams;
  const Surroundings surroundings({});
  const Sight sight{{{0, 0, 30}, {10, 0, 2}}, beams, surroundings, SE3::Identity()};
  EXPECT_NEAR(nearest_range({3, 4}, sight), 5, 1e-12);
  EXPECT_NEAR(nearest_range({10, 2}, sight), 2, 1e-12);
}

/// One beam along x at a height of 1 m; the points' frame lies 5 m ahead, turned by a quarter.
TEST(Sight, LooksAtABoxInTheFrameOfTheBeams) {
  Window window;
  window.sensors = {{0, 0, 1}};
  window.beams = {{{20, 0, 1}, 0}};
  Beams beams;
  beams.fill(window);
  const Surroundings surroundings({});
  SE3 T_level_local = SE3::Identity();
  T_level_local.translation() << 5, 0, 0;
  T_level_local.rotate(Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ()));
  const Sight sight{{{0, 0, 1}}, beams, surroundings, T_level_local};
  const auto box_at = [](double x, double y) {
    return upright(0, {Eigen::Vector2d(x - 0.5, y - 0.5), {x + 0.5, y + 0.5}}, {0.5, 1.5});
  };
  const objects::Cuboid far = upright(0, {Eigen::Vector2d(50, 50), {51, 51}}, {0, 1});
  EXPECT_EQ(sight.through(box_at(0, -3), far), 1) << "8 m ahead of the sensor";
  EXPECT_EQ(sight.through(box_at(3, 0), far), 0) << "3 m to its left";
  EXPECT_EQ(sight.ended(box_at(0, -15)), 1);
  EXPECT_EQ(sight.ended(box_at(0, -3)), 0);
  EXPECT_EQ(sight.others(box_at(0, -3)), 0);
}

}  // namespace
}  // namespace saker::detection
