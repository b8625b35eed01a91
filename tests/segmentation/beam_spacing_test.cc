#include "saker/segmentation/beam_spacing.h"

#include <gtest/gtest.h>

#include <numbers>

#include "lidar/made_scan.h"
#include "saker/core/rng.h"

namespace saker::segmentation {
namespace {

using lidar::testing::MadeScan;

constexpr float kDegree = std::numbers::pi_v<float> / 180;

struct Made {
  RangeImage image;
  BeamSpacing spacing;

  explicit Made(const MadeScan& scan) {
    project(scan.organised(), image);
    spacing.measure(image);
  }

  [[nodiscard]] std::size_t at(int row, int column) const {
    return static_cast<std::size_t>(row) * image.columns + column;
  }
  void move(std::size_t i, float range) {
    image.points[i] *= range / image.range[i];
    image.range[i] = range;
  }
};

/// A wall all about, so near that all rows but the lowest few hit it.
MadeScan near_wall() {
  return {.height_m = 2, .wall_m = 5, .elevation_deg = lidar::testing::uneven_elevations()};
}

TEST(BeamSpacing, PitchIsThatOfUnevenBeams) {
  const std::vector<float> elevations = lidar::testing::uneven_elevations();
  const Made made({.wall_m = 4, .elevation_deg = elevations});
  for (int row = 5; row + 1 < 64; ++row) {
    EXPECT_NEAR(made.spacing.pitch(row) / kDegree, elevations[row] - elevations[row + 1], 0.01)
        << row;
  }
}

TEST(BeamSpacing, RowsBelowAndAboveAreTheFirstOnesThatFarAway) {
  const std::vector<float> elevations = lidar::testing::uneven_elevations();
  const Made made({.wall_m = 4, .elevation_deg = elevations});
  const auto apart = [&](int a, int b) { return 5 * (elevations[a] - elevations[b]) * kDegree; };
  for (int row = 20; row < 40; ++row) {
    const int below = made.spacing.row_below(row, 5, kBaseline);
    EXPECT_GT(apart(row, below), kBaseline * 0.99F);
    EXPECT_TRUE(below == row + 1 || apart(row, below - 1) < kBaseline * 1.01F) << row;
    const int above = made.spacing.row_above(row, 5, kBaseline);
    EXPECT_GT(apart(above, row), kBaseline * 0.99F);
    EXPECT_TRUE(above == row - 1 || apart(above + 1, row) < kBaseline * 1.01F) << row;
  }
}

TEST(BeamSpacing, FarAwayTheNextBeamIsTheNeighbour) {
  const Made made({});
  EXPECT_EQ(made.spacing.row_below(30, 60, kBaseline), 31);
  EXPECT_EQ(made.spacing.row_above(30, 60, kBaseline), 29);
  EXPECT_EQ(made.spacing.columns(60, kBaseline), 1);
  EXPECT_EQ(made.spacing.row_below(63, 60, kBaseline), 63);
  EXPECT_EQ(made.spacing.row_above(0, 60, kBaseline), 0);
}

TEST(BeamSpacing, ColumnsSpanTheMetresAsked) {
  const Made made({});
  const float apart = 5 * 2 * std::numbers::pi_v<float> / 1024;
  EXPECT_EQ(made.spacing.columns(5, kBaseline), static_cast<int>(std::ceil(kBaseline / apart)));
  EXPECT_LE(made.spacing.columns(0.01F, kBaseline), 64);
}

TEST(BeamSpacing, OfAnEmptyImageIsFinite) {
  const Made made({.height_m = 1000, .wall_m = 1e6F});
  for (int row = 0; row < made.image.rows; ++row)
    EXPECT_TRUE(std::isfinite(made.spacing.pitch(row)));
}

TEST(SmoothRanges, LeaveAFifthOfTheVarianceOfANoisyWallNearby) {
  Made made(near_wall());
  const std::vector<float> exact = made.image.range;
  core::Rng rng(1);
  for (std::size_t i = 0; i < made.image.size(); ++i) {
    if (made.image.valid(i)) made.move(i, exact[i] + static_cast<float>(rng.normal(0, 0.034)));
  }
  RangeImage smooth;
  smooth_ranges(made.image, made.spacing, smooth);
  double before = 0, after = 0;
  for (std::size_t i = made.at(6, 0); i < made.at(50, 0); ++i) {
    before += std::pow(made.image.range[i] - exact[i], 2);
    after += std::pow(smooth.range[i] - exact[i], 2);
    ASSERT_NEAR(smooth.points[i].norm(), smooth.range[i], 1e-4);
  }
  EXPECT_LT(after, before / 5);
}

TEST(SmoothRanges, LeaveAPoleBeforeAWallWhereItIs) {
  Made made(near_wall());
  for (int row = 10; row < 40; ++row) {
    for (int column = 100; column < 104; ++column) made.move(made.at(row, column), 3);
  }
  RangeImage smooth;
  smooth_ranges(made.image, made.spacing, smooth);
  for (int row = 10; row < 40; ++row) {
    for (int column = 95; column < 110; ++column) {
      const std::size_t i = made.at(row, column);
      ASSERT_NEAR(smooth.range[i], made.image.range[i], 0.01);
    }
  }
}

TEST(SmoothRanges, LeaveWhatIsFarAsItIs) {
  const Made made({.wall_m = 30});
  RangeImage smooth;
  smooth_ranges(made.image, made.spacing, smooth);
  for (std::size_t i = 0; i < made.at(20, 0); ++i) {
    if (made.image.valid(i) && made.image.range[i] > 20) {
      ASSERT_EQ(smooth.range[i], made.image.range[i]);
    }
  }
}

}  // namespace
}  // namespace saker::segmentation
