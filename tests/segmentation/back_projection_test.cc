#include "saker/segmentation/back_projection.h"

#include <gtest/gtest.h>

namespace saker::segmentation {
namespace {

/// Two rows of eight pixels: class 1 in the first column, class 0 elsewhere.
struct Small {
  lidar::Scan scan;
  RangeImage image;
  PixelProbabilities pixels;

  Small() {
    scan.rows = 2;
    scan.columns = 8;
    for (int i = 0; i < 16; ++i) {
      const float azimuth = 0.5F * static_cast<float>(i % 8);
      scan.points.emplace_back(10 * std::cos(azimuth), 10 * std::sin(azimuth), i < 8 ? 0.5F : 0.0F);
    }
    project(scan, image);
    pixels = {2, 2, 8, std::vector<float>(32, 0.2F)};
    for (std::size_t i = 0; i < 16; ++i) pixels.values[2 * i + (i % 8 == 0 ? 1 : 0)] = 0.8F;
  }
};

TEST(BackProjection, GivesAPointTheClassOfItsSurface) {
  const Small small;
  const lidar::Labels labels = BackProjection().label(small.scan, small.image, small.pixels);
  for (std::size_t i = 0; i < 16; ++i) {
    EXPECT_EQ(labels.classes[i], i % 8 == 0 ? 1 : 0);
    EXPECT_NEAR(labels.probability[i], 0.8F, 0.02F);
  }
}

TEST(BackProjection, GivesAHiddenPointTheClassOfThePointsBesideIt) {
  Small small;
  // Behind the pixel in front of it (class 1), but beside the point of the next column (class 0).
  small.scan.points.push_back(small.scan.points[1] + Eigen::Vector3f(0.01F, 0, 0));
  small.image.pixel.push_back(0);
  const lidar::Labels labels = BackProjection().label(small.scan, small.image, small.pixels);
  EXPECT_EQ(labels.classes.back(), 0);
}

TEST(BackProjection, LeavesAPointWithoutAPixelUnclassified) {
  Small small;
  small.scan.points.push_back(Eigen::Vector3f::Constant(NAN));
  small.image.pixel.push_back(-1);
  const lidar::Labels labels = BackProjection().label(small.scan, small.image, small.pixels);
  EXPECT_EQ(labels.classes.back(), 0);
  EXPECT_EQ(labels.probability.back(), 0);
}

}  // namespace
}  // namespace saker::segmentation
