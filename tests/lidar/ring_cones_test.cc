#include "saker/lidar/ring_cones.h"

#include <gtest/gtest.h>

#include <cmath>

#include "made_scan.h"
#include "saker/core/rng.h"

namespace saker::lidar {
namespace {

/// Of a sensor at −0.6, 0.3, 1.7 m, rolled by 0.02 rad.
Scan moved_scan() {
  Eigen::Isometry3f T = Eigen::Isometry3f::Identity();
  T.translation() << -0.6F, 0.3F, 1.7F;
  T.linear() = Eigen::AngleAxisf(0.02F, Eigen::Vector3f::UnitX()).toRotationMatrix();
  return testing::scan_in(T);
}

void expect_truth(const std::optional<RingCones>& found) {
  ASSERT_TRUE(found);
  EXPECT_LT((found->pose.head<3>() - Eigen::Vector3f(-0.6F, 0.3F, 1.7F)).norm(), 0.05F);
  EXPECT_NEAR(found->pose[3], 0.02F, 0.003F);
  EXPECT_NEAR(found->pose[4], 0, 0.003F);
  EXPECT_LT(found->spread, 0.001F);
}

TEST(RingCones, MeetWhereTheBeamsStart) {
  const Scan scan = moved_scan();
  expect_truth(fit_ring_cones(scan.points, scan.ring));
}

TEST(RingCones, DoNotMindTheOrderOfTheRingNumbers) {
  Scan scan = moved_scan();
  for (std::uint16_t& ring : scan.ring) ring = static_cast<std::uint16_t>(37 * ring % 64 + 60'000);
  expect_truth(fit_ring_cones(scan.points, scan.ring));
}

TEST(RingCones, AreFoundThoughATenthOfTheNumbersIsWrong) {
  Scan scan = moved_scan();
  core::Rng rng(4);
  for (std::size_t i = 0; i < scan.size(); i += 10) {
    scan.ring[i] = static_cast<std::uint16_t>(rng.index(64));
  }
  const auto found = fit_ring_cones(scan.points, scan.ring);
  ASSERT_TRUE(found);
  EXPECT_LT((found->pose.head<3>() - Eigen::Vector3f(-0.6F, 0.3F, 1.7F)).norm(), 0.1F);
}

TEST(RingCones, AreNoneWhereTheFrameIsTheSensors) {
  const Scan scan = testing::scan_in(Eigen::Isometry3f::Identity());
  EXPECT_FALSE(fit_ring_cones(scan.points, scan.ring));
}

TEST(RingCones, AreNoneOfNumbersAtRandom) {
  Scan scan = moved_scan();
  core::Rng rng(5);
  for (std::uint16_t& ring : scan.ring) ring = static_cast<std::uint16_t>(rng.index(64));
  EXPECT_FALSE(fit_ring_cones(scan.points, scan.ring));
}

TEST(RingCones, AreNoneOfFewPointsFewRingsOrTooMany) {
  const Scan scan = moved_scan();
  std::vector<std::uint16_t> few = scan.ring, many = scan.ring;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    few[i] = static_cast<std::uint16_t>(scan.ring[i] / 10);
    many[i] = static_cast<std::uint16_t>(i);
  }
  EXPECT_FALSE(fit_ring_cones(scan.points, few));
  EXPECT_FALSE(fit_ring_cones(scan.points, many));
  EXPECT_FALSE(fit_ring_cones(std::vector(scan.points.begin(), scan.points.begin() + 900),
                              std::vector(scan.ring.begin(), scan.ring.begin() + 900)));
  EXPECT_FALSE(fit_ring_cones({}, {}));
}

}  // namespace
}  // namespace saker::lidar
