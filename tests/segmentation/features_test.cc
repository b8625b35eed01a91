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

/// Every second beam left out: the way to the next one is twice as long.
TEST(Features, TellHowFarApartTheBeamsAre) {
  RangeImage dense, sparse;
  std::vector<float> few;
  const std::vector<float> even = {4, 3, 2, 1, 0, -1, -2, -3, -4, -5, -6, -7, -8, -9, -10, -11};
  for (std::size_t i = 0; i < even.size(); i += 2) few.push_back(even[i]);
  project(MadeScan{.rows = 16, .elevation_deg = even}.organised(), dense);
  project(MadeScan{.rows = 8, .elevation_deg = few}.organised(), sparse);
  Features of_dense, of_sparse;
  const float one = of_dense.compute(dense)[9 * dense.size() + 10 * 1024 + 5];
  const float two = of_sparse.compute(sparse)[9 * sparse.size() + 5 * 1024 + 5];
  EXPECT_NEAR(two - one, std::log(2.0F) / 2, 0.01);
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
