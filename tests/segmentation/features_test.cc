#include "saker/segmentation/features.h"

#include <gtest/gtest.h>

#include <numbers>

#include "lidar/made_scan.h"
#include "saker/core/rng.h"

namespace saker::segmentation {
namespace {

using lidar::testing::MadeScan;

TEST(Features, AreFiniteBoundedAndZeroWhereNothingReturned) {
  for (const float height : {1.0F, 12.0F, 1000.0F}) {
    RangeImage image;
    project(MadeScan{.height_m = height}.organised(), image);
    Features features;
    const std::vector<float>& values = features.compute(image);
    ASSERT_EQ(values.size(), kChannelCount * image.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      ASSERT_TRUE(std::isfinite(values[i]));
      ASSERT_LE(std::abs(values[i]), 5.5F) << kChannels[i / image.size()];
      if (!image.valid(i % image.size())) {
        ASSERT_EQ(values[i], 0);
      }
    }
  }
}

TEST(Features, OfTheGroundAreLevelAndOfAWallUpright) {
  RangeImage image;
  project(MadeScan{}.organised(), image);
  Features features;
  const std::vector<float>& values = features.compute(image);
  const std::size_t pixels = image.size(), ground = 60 * 1024 + 100, wall = 24 * 1024 + 100;
  EXPECT_NEAR(values[4 * pixels + ground], 1, 0.02);
  EXPECT_NEAR(values[2 * pixels + ground], 0, 0.03);
  EXPECT_NEAR(values[9 * pixels + ground], 0, 0.02);
  EXPECT_NEAR(values[4 * pixels + wall], 0, 0.05);
  EXPECT_NEAR(values[9 * pixels + wall], 1, 0.05);
}

/// A wall 4 m away whose points are a centimetre apart and scatter by as much as three of them.
TEST(Features, OfANoisyWallCloseByAreThoseOfAWall) {
  RangeImage image;
  project(MadeScan{.wall_m = 4, .elevation_deg = lidar::testing::uneven_elevations()}.organised(),
          image);
  core::Rng rng(1);
  for (std::size_t i = 0; i < image.size(); ++i) {
    if (!image.valid(i)) continue;
    const auto scale = static_cast<float>(1 + rng.normal(0, 0.034) / image.range[i]);
    image.points[i] *= scale;
    image.range[i] *= scale;
  }
  Features features;
  const std::vector<float>& values = features.compute(image);
  double normal_up = 0, slope = 0;
  int count = 0;
  for (std::size_t i = 10 * 1024; i < 40 * 1024; ++i, ++count) {
    normal_up += std::pow(values[4 * image.size() + i], 2);
    slope += std::pow(values[9 * image.size() + i] - 1, 2);
  }
  EXPECT_LT(std::sqrt(normal_up / count), 0.15);
  EXPECT_LT(std::sqrt(slope / count), 0.15);
}

TEST(Features, AreTheSameOfASparserSensor) {
  RangeImage dense, sparse;
  project(MadeScan{.wall_m = 6}.organised(), dense);
  project(MadeScan{.rows = 32, .columns = 512, .wall_m = 6}.organised(), sparse);
  Features of_dense, of_sparse;
  const std::vector<float>& a = of_dense.compute(dense);
  const std::vector<float>& b = of_sparse.compute(sparse);
  for (const auto& [row, of] : {std::pair(12, 24), std::pair(20, 39), std::pair(30, 59)}) {
    const std::size_t i = of * 1024 + 200, j = row * 512 + 100;
    for (const std::size_t channel : {2, 4, 7, 9, 10}) {
      EXPECT_NEAR(a[channel * dense.size() + i], b[channel * sparse.size() + j], 0.06)
          << kChannels[channel] << ' ' << row;
    }
  }
}

TEST(Features, TellHowFarApartTheBeamsAre) {
  RangeImage image;
  project(MadeScan{}.organised(), image);
  Features features;
  const std::vector<float>& values = features.compute(image);
  const std::size_t i = 30 * 1024 + 100;
  const double pitch = 40.0 / 63 * std::numbers::pi / 180;
  EXPECT_NEAR(values[11 * image.size() + i], std::log(image.range[i] * pitch / 0.3) / 2, 0.01);
}

TEST(Features, InAMirrorAreThoseOfTheMirroredScan) {
  const lidar::Scan scan = lidar::testing::with_handedness(MadeScan{}.organised());
  RangeImage image, other;
  project(scan, image);
  project(lidar::testing::mirrored(scan), other);
  Features features, of_other;
  (void)features.compute(image);
  const std::vector<float>& found = features.mirrored();
  const std::vector<float>& expected = of_other.compute(other);
  ASSERT_EQ(found.size(), expected.size());
  std::size_t off = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    off += std::abs(found[i] - expected[i]) > 1e-3F ? 1 : 0;
  }
  EXPECT_LT(off, found.size() / 1000);
}

TEST(Features, DoNotDependOnWhatWasComputedBefore) {
  RangeImage one, other;
  project(MadeScan{}.organised(), one);
  project(MadeScan{.rows = 32, .columns = 512, .height_m = 5}.organised(), other);
  Features used, fresh;
  (void)used.compute(other);
  EXPECT_EQ(used.compute(one), fresh.compute(one));
}

}  // namespace
}  // namespace saker::segmentation
