#include "saker/uncertainty/intervals.h"

#include <gtest/gtest.h>

#include <numbers>
#include <set>

namespace saker::uncertainty {
namespace {

constexpr double kPi = std::numbers::pi;
const Intervals kIntervals{{2, 4, 8, 12}, 6};

View seen_from(double range, double angle) { return {range, angle, NAN, NAN}; }

TEST(IntervalsTest, EachCentreLiesInItsInterval) {
  std::set<int> all;
  for (int range = 0; range < kIntervals.ranges(); ++range) {
    for (int sector = 0; sector < kIntervals.sectors; ++sector) {
      const View view = seen_from(kIntervals.range_centre(range), kIntervals.sector_centre(sector));
      EXPECT_EQ(kIntervals.of(view), kIntervals.index(range, sector));
      all.insert(kIntervals.of(view));
    }
  }
  EXPECT_EQ(static_cast<int>(all.size()), kIntervals.size());
}

TEST(IntervalsTest, CentresLieHalfWayBetweenTheEdges) {
  EXPECT_EQ(kIntervals.range_centre(1), 6);
  EXPECT_NEAR(kIntervals.sector_centre(0), kPi / 12, 1e-12);
  EXPECT_NEAR(kIntervals.sector_centre(5), kPi - kPi / 12, 1e-12);
}

TEST(IntervalsTest, LeftAndRightShareAnIntervalWhateverTheAngle) {
  for (double angle = 0.05; angle < kPi; angle += 0.1) {
    const View left = seen_from(5, angle), right = seen_from(5, -angle);
    EXPECT_EQ(kIntervals.of(left), kIntervals.of(right)) << angle;
    EXPECT_TRUE(kIntervals.mirrored(right)) << angle;
    EXPECT_FALSE(kIntervals.mirrored(left)) << angle;
  }
}

TEST(IntervalsTest, CellsAreNumberedWithoutGapsTwoAnInterval) {
  std::set<int> cells;
  for (double range = 2.1; range < 12; range += 0.3) {
    for (double angle = -3.1; angle <= 3.1; angle += 0.1) {
      cells.insert(kIntervals.cell_of(seen_from(range, angle)));
    }
  }
  EXPECT_EQ(static_cast<int>(cells.size()), 2 * kIntervals.size());
  EXPECT_EQ(*cells.begin(), 0);
  EXPECT_EQ(*cells.rbegin(), 2 * kIntervals.size() - 1);
}

TEST(IntervalsTest, AnEdgeBelongsToTheFartherInterval) {
  EXPECT_EQ(kIntervals.of(seen_from(std::nextafter(4.0, 0.0), 0)), kIntervals.index(0, 0));
  EXPECT_EQ(kIntervals.of(seen_from(4, 0)), kIntervals.index(1, 0));
}

TEST(IntervalsTest, RangesOutsideTheEdgesAreNotContainedButHaveANearestInterval) {
  EXPECT_TRUE(kIntervals.contains(2) && kIntervals.contains(12));
  EXPECT_FALSE(kIntervals.contains(1.99) || kIntervals.contains(12.01));
  EXPECT_EQ(kIntervals.of(seen_from(0, 0)), kIntervals.index(0, 0));
  EXPECT_EQ(kIntervals.of(seen_from(1e6, 0)), kIntervals.index(2, 0));
}

TEST(IntervalsTest, StraightBehindIsInTheLastSectorFromEitherSide) {
  EXPECT_EQ(kIntervals.of(seen_from(3, kPi)), kIntervals.index(0, 5));
  EXPECT_EQ(kIntervals.of(seen_from(3, -kPi)), kIntervals.index(0, 5));
}

TEST(IntervalsTest, WithOneSectorTheAngleDoesNotMatter) {
  const Intervals round{{2, 4, 8}, 1};
  for (const double angle : {-3.0, -0.5, 0.0, 2.0}) {
    EXPECT_EQ(round.of(seen_from(5, angle)), 1) << angle;
    EXPECT_FALSE(round.mirrored(seen_from(5, angle))) << angle;
  }
}

}  // namespace
}  // namespace saker::uncertainty
