#include "saker/core/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

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

}  // namespace
}  // namespace saker::core
