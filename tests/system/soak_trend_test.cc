#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "saker/core/rng.h"
#include "tools/saker/soak/trend.h"

namespace saker::tools {
namespace {

/// n samples, one a unit of time.
Series made(int n, double slope, double noise, std::uint64_t seed = 1) {
  core::Rng rng(seed);
  Series series;
  for (int i = 0; i < n; ++i) {
    series.times.push_back(i);
    series.values.push_back(100 + slope * i + rng.normal(0, noise));
  }
  return series;
}

Trend of(const Series& series) { return trend_of(series.times, series.values); }

TEST(SoakTrend, ALineWithoutNoiseIsFoundExactly) {
  const Trend trend = of(made(20, 0.25, 0));
  EXPECT_NEAR(trend.slope, 0.25, 1e-12);
  EXPECT_NEAR(trend.low, 0.25, 1e-12);
  EXPECT_NEAR(trend.high, 0.25, 1e-12);
}

TEST(SoakTrend, WhatNeverChangesHasNoSlopeForSure) {
  const Trend trend = of(made(20, 0, 0));
  EXPECT_EQ(trend.slope, 0);
  EXPECT_EQ(trend.low, 0);
  EXPECT_EQ(trend.high, 0);
}

/// Of ten values without ties S has variance 10 · 9 · 25 / 18 = 125: of 45 slopes the interval
/// leaves out ten at each end.
TEST(SoakTrend, TheIntervalLiesBetweenTheRanksThatKendallsStatisticGives) {
  const Series series = made(10, 1, 3);
  std::vector<double> slopes;
  for (int i = 0; i < 10; ++i) {
    for (int j = i + 1; j < 10; ++j) {
      slopes.push_back((series.values[j] - series.values[i]) / (j - i));
    }
  }
  std::sort(slopes.begin(), slopes.end());
  const Trend trend = of(series);
  EXPECT_DOUBLE_EQ(trend.slope, slopes[22]);
  EXPECT_DOUBLE_EQ(trend.low, slopes[10]);
  EXPECT_DOUBLE_EQ(trend.high, slopes[34]);
}

TEST(SoakTrend, TheIntervalHoldsTheTruthInNineteenOfTwentySeries) {
  int held = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    const Trend trend = of(made(25, 0.5, 2, seed));
    held += trend.low <= 0.5 && 0.5 <= trend.high;
  }
  EXPECT_NEAR(held / 400.0, 0.95, 0.035);
}

TEST(SoakTrend, OutliersDoNotMoveIt) {
  Series series = made(30, 0, 1);
  for (const std::size_t i : {3, 11, 25, 29}) series.values[i] += 1000;
  const Trend trend = of(series);
  EXPECT_LT(std::abs(trend.slope), 0.2);
  EXPECT_LT(trend.low, 0);
}

TEST(SoakTrend, ThreeSamplesHaveNoInterval) {
  const Trend trend = of(made(3, 1, 0));
  EXPECT_NEAR(trend.slope, 1, 1e-12);
  EXPECT_TRUE(std::isnan(trend.low));
}

TEST(SoakTrend, SamplesAtOneTimeHaveNoSlope) {
  EXPECT_TRUE(std::isnan(trend_of(std::vector{1.0, 1.0}, std::vector{2.0, 3.0}).slope));
}

TEST(SoakTrend, ThinningKeepsSlopeAndLevel) {
  const Series series = made(1000, 0.25, 0);
  const Series thin = thinned(series, 40);
  ASSERT_EQ(thin.times.size(), 40u);
  EXPECT_NEAR(of(thin).slope, 0.25, 1e-9);
  EXPECT_NEAR(of(thin).level, 100 + 0.25 * 499.5, 0.5);
  EXPECT_EQ(thinned(series, 1000).times, series.times);
}

TEST(SoakTrend, TheFirstFifthOfTheTimeIsLeftOut) {
  const Series rest = settled(made(11, 0, 0), 0.2);
  EXPECT_EQ(rest.times.front(), 2);
  EXPECT_EQ(rest.times.size(), 9u);
}

TEST(SoakTrend, AFloorRisesWhereWhatWasTakenIsNotGivenBack) {
  EXPECT_TRUE(floor_rises(std::vector<double>{7, 9, 8, 8, 10, 9}));
  EXPECT_FALSE(floor_rises(std::vector<double>{7, 9, 8, 12, 7, 12}));
  EXPECT_FALSE(floor_rises(std::vector<double>{7, 8, 9}));
}

}  // namespace
}  // namespace saker::tools
