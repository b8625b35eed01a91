#include "saker/core/colour.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace saker::core {
namespace {

const std::vector<Colour> kAll = {colours::kInk,    colours::kGrey,  colours::kBlue,
                                  colours::kOrange, colours::kGreen, colours::kPurple,
                                  colours::kYellow, colours::kSky};

double distance(const Colour& a, const Colour& b) {
  return std::hypot(a.red - b.red, a.green - b.green, a.blue - b.blue);
}

TEST(Colours, DifferFromEachOtherAndFromWhite) {
  for (std::size_t i = 0; i < kAll.size(); ++i) {
    EXPECT_GT(distance(kAll[i], {255, 255, 255}), 100) << i;
    for (std::size_t k = 0; k < i; ++k) EXPECT_GT(distance(kAll[i], kAll[k]), 60) << i << " " << k;
  }
}

/// Okabe and Ito, "Color Universal Design", 2008.
TEST(Colours, AreThoseOfTheirSource) {
  EXPECT_EQ(distance(colours::kBlue, {0, 114, 178}), 0);
  EXPECT_EQ(distance(colours::kOrange, {213, 94, 0}), 0);
  EXPECT_EQ(distance(colours::kGreen, {0, 158, 115}), 0);
  EXPECT_EQ(distance(colours::kSky, {86, 180, 233}), 0);
}

}  // namespace
}  // namespace saker::core
