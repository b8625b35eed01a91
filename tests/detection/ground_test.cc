#include "detection/ground.h"

#include <gtest/gtest.h>

#include "core/rng.h"

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
  ground.fit(sloped(0.2, 0, rng), 30);
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
  ground.fit(points, 30);
  ASSERT_NE(ground.at({4.7, 2.7, 0}), nullptr);
  EXPECT_NEAR(ground.at({4.7, 2.7, 0})->height_of({4.7, 2.7, 0}), 0, 0.05);
}

TEST(Ground, IsNotKnownFarFromWhereItWasSeen) {
  core::Rng rng(3);
  Ground ground({});
  ground.fit(sloped(0, 0, rng), 60);
  EXPECT_NE(ground.at({18, 0, 0}), nullptr);
  EXPECT_EQ(ground.at({40, 0, 0}), nullptr);
  EXPECT_EQ(ground.at({NAN, 0, 0}), nullptr);
}

TEST(Ground, OfNoPointsHasNoPlanes) {
  Ground ground({});
  ground.fit({}, 60);
  EXPECT_TRUE(ground.planes().empty());
}

}  // namespace
}  // namespace saker::detection
