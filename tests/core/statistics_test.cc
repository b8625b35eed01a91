#include "saker/core/statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "saker/core/rng.h"

namespace saker::core {
namespace {

using Values = std::vector<double>;

TEST(Statistics, MomentsOfAKnownSample) {
  const Values v = {2, 4, 4, 4, 5, 5, 7, 9};
  EXPECT_DOUBLE_EQ(mean(v), 5);
  EXPECT_DOUBLE_EQ(standard_deviation(v), std::sqrt(32.0 / 7));
  EXPECT_DOUBLE_EQ(mean_absolute(Values{-3, 1}), 2);
}

TEST(Statistics, PercentilesInterpolate) {
  const Values v = {40, 10, 30, 20};
  EXPECT_DOUBLE_EQ(percentile(v, 0), 10);
  EXPECT_DOUBLE_EQ(percentile(v, 1), 40);
  EXPECT_DOUBLE_EQ(median(v), 25);
  EXPECT_DOUBLE_EQ(percentile(v, 0.1), 13);
  EXPECT_DOUBLE_EQ(median(Values{7}), 7);
}

TEST(Statistics, ALineIsFoundExactly) {
  const Values x = {0, 1, 3, 7}, y = {2, 1.5, 0.5, -1.5};
  const Line line = fit_line(x, y);
  EXPECT_NEAR(line.slope, -0.5, 1e-12);
  EXPECT_NEAR(line.offset, 2, 1e-12);
}

TEST(Statistics, WhatIsNotDefinedIsNaN) {
  EXPECT_TRUE(std::isnan(mean({})));
  EXPECT_TRUE(std::isnan(median({})));
  EXPECT_TRUE(std::isnan(standard_deviation(Values{1})));
  EXPECT_TRUE(std::isnan(fit_line(Values{1, 1}, Values{0, 5}).slope));
}

/// 200 numbers without order.
Values made(double scale = 1, double shift = 0) {
  Rng rng(3);
  Values values;
  for (int i = 0; i < 200; ++i) values.push_back(shift + scale * rng.normal(1, 2));
  return values;
}

TEST(Statistics, FollowAChangeOfUnitAndOrigin) {
  const Values v = made(), changed = made(100, -7);
  EXPECT_NEAR(mean(changed), 100 * mean(v) - 7, 1e-9);
  EXPECT_NEAR(median(changed), 100 * median(v) - 7, 1e-9);
  EXPECT_NEAR(percentile(changed, 0.9), 100 * percentile(v, 0.9) - 7, 1e-9);
  EXPECT_NEAR(standard_deviation(changed), 100 * standard_deviation(v), 1e-9);
}

TEST(Statistics, DoNotDependOnTheOrder) {
  const Values v = made(), reversed(v.rbegin(), v.rend());
  EXPECT_NEAR(mean(reversed), mean(v), 1e-12);
  for (const double ratio : {0.0, 0.13, 0.5, 0.99}) {
    EXPECT_EQ(percentile(reversed, ratio), percentile(v, ratio)) << ratio;
  }
}

TEST(Statistics, PercentilesRiseWithTheirRatioFromTheLeastToTheMost) {
  const Values v = made();
  EXPECT_EQ(percentile(v, 0), *std::ranges::min_element(v));
  EXPECT_EQ(percentile(v, 1), *std::ranges::max_element(v));
  for (double ratio = 0.05; ratio <= 1; ratio += 0.05) {
    EXPECT_GT(percentile(v, ratio), percentile(v, ratio - 0.05)) << ratio;
  }
  EXPECT_EQ(percentile(v, -1), percentile(v, 0));
  EXPECT_EQ(percentile(v, 2), percentile(v, 1));
}

TEST(Statistics, ADistantOriginDoesNotDrownTheDeviation) {
  EXPECT_NEAR(standard_deviation(made(1, 1e9)), standard_deviation(made()), 1e-5);
}

TEST(Statistics, OfALineTheResidualsAreNeitherOffNorSloped) {
  const Values x = made();
  Rng rng(8);
  Values y;
  for (const double at : x) y.push_back(3 * at - 1 + rng.normal());
  const Line line = fit_line(x, y);
  EXPECT_NEAR(line.slope, 3, 0.2);
  double sum = 0, along = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double residual = y[i] - line.slope * x[i] - line.offset;
    sum += residual;
    along += residual * x[i];
  }
  EXPECT_NEAR(sum, 0, 1e-9);
  EXPECT_NEAR(along, 0, 1e-9);
}

}  // namespace
}  // namespace saker::core
