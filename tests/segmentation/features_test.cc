#include "segmentation/features.h"

#include <gtest/gtest.h>

#include "lidar/made_scan.h"

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
  EXPECT_NEAR(values[7 * pixels + ground], 0, 0.02);
  EXPECT_NEAR(values[4 * pixels + wall], 0, 0.05);
  EXPECT_NEAR(values[7 * pixels + wall], 1, 0.05);
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
