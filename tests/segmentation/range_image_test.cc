#include "saker/segmentation/range_image.h"

#include <gtest/gtest.h>

#include <limits>

#include "lidar/made_scan.h"

namespace saker::segmentation {
namespace {

using lidar::testing::MadeScan;
using lidar::testing::ring_by_ring;

RangeImage image_of(const lidar::Scan& scan) {
  RangeImage image;
  project(scan, image);
  return image;
}

void expect_every_finite_point_has_a_pixel(const lidar::Scan& scan, const RangeImage& image) {
  ASSERT_EQ(image.pixel.size(), scan.size());
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (!scan.points[i].allFinite()) {
      ASSERT_EQ(image.pixel[i], -1);
      continue;
    }
    ASSERT_GE(image.pixel[i], 0) << "point " << i;
    const std::size_t pixel = image.pixel[i];
    ASSERT_LT(pixel, image.size());
    ASSERT_LE(image.range[pixel], scan.points[i].norm() + 1e-5F);
  }
}

TEST(RangeImage, GivesEveryFinitePointAPixelThatShowsNothingFartherAway) {
  const lidar::Scan organised = MadeScan{}.organised();
  expect_every_finite_point_has_a_pixel(organised, image_of(organised));
  const auto file = ring_by_ring(organised);
  expect_every_finite_point_has_a_pixel(file.scan, image_of(file.scan));
}

TEST(RangeImage, KeepsThePixelsOfAnOrganisedScan) {
  const lidar::Scan scan = MadeScan{}.organised();
  const RangeImage image = image_of(scan);
  ASSERT_EQ(image.rows, 64);
  ASSERT_EQ(image.columns, 1024);
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (scan.points[i].allFinite()) {
      ASSERT_EQ(image.pixel[i], static_cast<std::int32_t>(i));
    }
  }
}

TEST(RangeImage, OfTheFileIsThatOfTheOrganisedScan) {
  const lidar::Scan scan = MadeScan{.wall_m = 8}.organised();
  const auto file = ring_by_ring(scan);
  const RangeImage organised = image_of(scan), recovered = image_of(file.scan);
  ASSERT_EQ(recovered.columns, 1024);
  const std::size_t skipped = static_cast<std::size_t>(file.row.front()) * 1024;
  ASSERT_EQ(recovered.size() + skipped, organised.size());
  for (std::size_t i = 0; i < recovered.size(); ++i) {
    ASSERT_EQ(recovered.range[i], organised.range[i + skipped]) << "pixel " << i;
  }
}

TEST(RangeImage, HasNoEmptyRowHoweverUnevenlyTheBeamsLie) {
  const MadeScan sensor{.wall_m = 8, .elevation_deg = lidar::testing::uneven_elevations()};
  const auto file = shuffled(ring_by_ring(sensor.organised()), 2);
  const RangeImage image = image_of(file.scan);
  for (int row = 0; row < image.rows; ++row) {
    int seen = 0;
    for (int c = 0; c < image.columns; ++c) seen += image.valid(row * image.columns + c);
    EXPECT_GT(seen, image.columns * 9 / 10) << "row " << row;
  }
}

TEST(RangeImage, HalvesWhatIsMoreThanTheNetworkTakes) {
  const RangeImage image = image_of(MadeScan{.rows = 128, .columns = 2048}.organised());
  EXPECT_EQ(image.rows, 64);
  EXPECT_EQ(image.columns, 1024);
}

TEST(RangeImage, KeepsFewRowsAndHasFewColumnsForASparseSensor) {
  const auto scan = MadeScan{.rows = 16, .columns = 512, .wall_m = 5}.organised();
  EXPECT_EQ(image_of(scan).rows, 16);
  EXPECT_EQ(image_of(scan).columns, 512);
  EXPECT_EQ(image_of(ring_by_ring(scan).scan).columns, 512);
}

TEST(RangeImage, SurvivesPointsThatAreNoNumbers) {
  lidar::Scan scan;
  EXPECT_EQ(image_of(scan).size(), 0u);
  const float inf = std::numeric_limits<float>::infinity();
  for (const float bad : {NAN, inf, -inf, 0.0F, 1e30F}) {
    scan.points.emplace_back(bad, bad, bad);
  }
  const RangeImage image = image_of(scan);
  EXPECT_EQ(image.pixel.size(), scan.size());
}

}  // namespace
}  // namespace saker::segmentation
