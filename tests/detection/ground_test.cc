#include "saker/detection/ground.h"

#include <gtest/gtest.h>

#include "saker/core/rng.h"

namespace saker::detection {
namespace {

std::vector<Eigen::Vector3f> sloped(double slope, double outliers, core::Rng& rng) {
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < 20000; ++i) {
    const double x = rng.uniform(-15, 15);
    const double lift = rng.chance(outliers) ? rng.uniform(0.3, 1) : 0;
    points.push_back(
        Eigen::Vector3d(x, rng.uniform(-15, 15), slope * x + lift + rng.normal(0, 0.02))
            .cast<float>());
  }
  return points;
}

TEST(Ground, FindsTheHeightAndNormalOfASlope) {
  core::Rng rng(1);
  Ground ground({});
  ground.fit(sloped(0.2, 0, rng), {}, 30);
  const auto* plane = ground.at({5, 3, 0});
  ASSERT_NE(plane, nullptr);
  EXPECT_NEAR(plane->height_of({5, 3, 1}), 0, 0.02);
  EXPECT_NEAR(plane->normal.dot(Eigen::Vector3d(-0.2, 0, 1).normalized()), 1, 1e-4);
}

TEST(Ground, IsNotLiftedByABonnetCalledGround) {
  core::Rng rng(2);
  std::vector<Eigen::Vector3f> points = sloped(0, 0, rng);
  for (int i = 0; i < 400; ++i) {
    points.push_back(Eigen::Vector3d(rng.uniform(4, 5.5), rng.uniform(2, 3.5), 0.8).cast<float>());
  }
  std::erase_if(points, [](const Eigen::Vector3f& p) {
    return p.x() > 4 && p.x() < 5.5 && p.y() > 2 && p.y() < 3.5 && p.z() < 0.5;
  });
  Ground ground({});
  ground.fit(points, {}, 30);
  ASSERT_NE(ground.at({4.7, 2.7, 0}), nullptr);
  EXPECT_NEAR(ground.at({4.7, 2.7, 0})->height_of({4.7, 2.7, 0}), 0, 0.05);
}

/// Height of the ground under a vehicle with its front to +x, of whose surroundings the ground
/// behind it alone is seen, and of whose bonnet the half beside the side that is seen was called
/// ground.
double height_under_bonnet(bool vehicle_seen) {
  core::Rng rng(4);
  std::vector<Eigen::Vector3f> points;
  std::vector<ClassPoint> vehicle;
  for (int i = 0; i < 400; ++i) {
    const auto y = static_cast<float>(rng.uniform(-0.9, 0));
    points.emplace_back(static_cast<float>(rng.uniform(-5, -2.5)), y, 0);
    points.emplace_back(static_cast<float>(rng.uniform(1, 2.2)), y, 1);
    const auto x = static_cast<float>(rng.uniform(-2.2, 2.2));  // of its side
    if (vehicle_seen) vehicle.push_back({{x, -0.9f, static_cast<float>(rng.uniform(0.2, 1))}});
  }
  Ground ground({});
  ground.fit(points, vehicle, 30);
  const objects::GroundPlane* plane = ground.at({1, 0, 0});
  return plane == nullptr ? NAN : -plane->height_of({1, 0, 0});
}

TEST(Ground, DoesNotLieOverAVehicle) {
  EXPECT_GT(height_under_bonnet(false), 0.5);  // nothing else tells
  EXPECT_NEAR(height_under_bonnet(true), 0, 0.05);
}

/// Degrees by which the ground under a pickup is off, whose load bed was called ground, and before
/// which none was seen; on a slope.
double tilt_under_load_bed(double slope, const GroundConfig& config) {
  core::Rng rng(5);
  std::vector<Eigen::Vector3f> points = sloped(slope, 0, rng);
  std::erase_if(points, [](const Eigen::Vector3f& p) { return p.x() > -1; });
  for (int i = 0; i < 400; ++i) {
    const double x = rng.uniform(0.5, 2);
    points.push_back(Eigen::Vector3d(x, rng.uniform(-0.8, 0.8), slope * x + 0.8).cast<float>());
  }
  Ground ground(config);
  ground.fit(points, {}, 30);
  const objects::GroundPlane* plane = ground.at({0.2, 0, 0});
  if (plane == nullptr) return NAN;
  const Eigen::Vector3d up = Eigen::Vector3d(-slope, 0, 1).normalized();
  return std::acos(std::min(1.0, plane->normal.dot(up))) * 180 / M_PI;
}

TEST(Ground, IsNotTiltedByALoadBedCalledGround) {
  GroundConfig without;
  without.bend_sd = 10;
  for (const double slope : {0.0, 0.15}) {
    EXPECT_GT(tilt_under_load_bed(slope, without), 12) << slope;
    EXPECT_LT(tilt_under_load_bed(slope, {}), 8) << slope;
  }
}

TEST(Ground, IsNotKnownFarFromWhereItWasSeen) {
  core::Rng rng(3);
  Ground ground({});
  ground.fit(sloped(0, 0, rng), {}, 60);
  EXPECT_NE(ground.at({18, 0, 0}), nullptr);
  EXPECT_EQ(ground.at({40, 0, 0}), nullptr);
  EXPECT_EQ(ground.at({NAN, 0, 0}), nullptr);
}

TEST(Ground, OfNoPointsHasNoPlanes) {
  Ground ground({});
  ground.fit({}, {}, 60);
  EXPECT_TRUE(ground.planes().empty());
}

}  // namespace
}  // namespace saker::detection
