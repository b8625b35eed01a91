#include "detection/vehicle.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "made_scene.h"

namespace saker::detection {
namespace {

using testing::MadeBox;
using testing::visible_box;

std::vector<BodyPoint> seen(const MadeBox& box, const Eigen::Vector3d& sensor, double speed = 0) {
  core::Rng rng(5);
  std::vector<BodyPoint> points;
  for (int scan = 0; scan < 10; ++scan) {
    const double seconds = 0.1 * (scan - 9);
    MadeBox now = box;
    now.x += speed * seconds * std::cos(box.yaw);
    now.y += speed * seconds * std::sin(box.yaw);
    for (const auto& p : visible_box(now, sensor, 300, 0.02, rng)) {
      if (p.z() > 0.2) points.push_back({p.cast<float>(), static_cast<float>(seconds)});
    }
  }
  return points;
}

double turned(const objects::Cuboid& cuboid, double yaw) {
  return std::abs(std::remainder(core::yaw(cuboid.pose.linear()) - yaw, M_PI));
}

TEST(Vehicle, IsMeasuredFromAnObliqueView) {
  for (const double yaw : {0.0, 0.4, 1.2, 2.3, -0.8}) {
    const VehicleFit fit = fit_vehicle(seen({10, 2, yaw}, {0, 0, 4}), {{0, 0, 4}}, {});
    ASSERT_EQ(fit.status, VehicleStatus::fitted) << yaw;
    EXPECT_NEAR(fit.cuboid.size.x(), 4.5, 0.15) << yaw;
    EXPECT_NEAR(fit.cuboid.size.y(), 1.8, 0.15) << yaw;
    EXPECT_NEAR(fit.cuboid.size.z(), 1.5, 0.08) << yaw;
    EXPECT_LT(turned(fit.cuboid, yaw), 0.03) << yaw;
    EXPECT_LT((fit.cuboid.pose.translation() - Eigen::Vector3d(10, 2, 0.75)).norm(), 0.12) << yaw;
  }
}

TEST(Vehicle, SeenFromBehindOnlyDoesNotClaimToKnowItsLength) {
  const VehicleFit fit = fit_vehicle(seen({12, 0, 0}, {0, 0, 1.2}), {{0, 0, 1.2}}, {});
  ASSERT_EQ(fit.status, VehicleStatus::fitted);
  EXPECT_LT(turned(fit.cuboid, 0), 0.05);
  EXPECT_NEAR(fit.cuboid.size.y(), 1.8, 0.15);
  EXPECT_GT(std::sqrt(fit.covariance(6, 6)), 0.3);
  EXPECT_LT(std::abs(fit.cuboid.size.x() - 4.5), 2 * std::sqrt(fit.covariance(6, 6)));
  EXPECT_LT(std::sqrt(fit.covariance(7, 7)), 0.2);
  EXPECT_LT(std::abs(fit.cuboid.pose.translation().x() - 12), 2 * std::sqrt(fit.covariance(3, 3)));
}

TEST(Vehicle, ThatMovesIsToldFromOneThatIsParked) {
  for (const double speed : {4.0, 8.0, 12.0}) {
    const VehicleFit fit = fit_vehicle(seen({12, 3, 0.3}, {0, 0, 2}, speed), {{0, 0, 2}}, {});
    EXPECT_TRUE(fit.motion.moving) << speed;
    EXPECT_NEAR(fit.motion.velocity.norm(), speed, 0.8);
  }
  EXPECT_FALSE(fit_vehicle(seen({12, 3, 0.3}, {0, 0, 2}), {{0, 0, 2}}, {}).motion.moving);
}

TEST(Vehicle, CovarianceIsSymmetricAndPositive) {
  const VehicleFit fit = fit_vehicle(seen({12, 3, 0.3}, {0, 0, 2}), {{0, 0, 2}}, {});
  EXPECT_LT((fit.covariance - fit.covariance.transpose()).norm(), 1e-12);
  EXPECT_GT(fit.covariance.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), 0);
}

}  // namespace
}  // namespace saker::detection
