#include "saker/active/views/sides.h"

#include <gtest/gtest.h>

#include <numbers>

namespace saker::active {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

Sides two_sides() { return Sides(24, 3.0, 120 * kDegree); }

TEST(Sides, OneCountsOnceItWasInViewForLongEnough) {
  Sides sides = two_sides();
  EXPECT_FALSE(sides.add(0.01, 2.0));
  EXPECT_EQ(sides.count(), 0);
  EXPECT_TRUE(sides.add(-0.01, 1.0));
  EXPECT_EQ(sides.count(), 1);
}

TEST(Sides, FlyingPastAddsUpNowhere) {
  Sides sides = two_sides();
  for (int degrees = 0; degrees < 360; degrees += 15) {
    EXPECT_FALSE(sides.add(degrees * kDegree, 2.0));
  }
}

TEST(Sides, AnotherCountsOnlyWhenItIsFarEnoughAround) {
  Sides sides = two_sides();
  ASSERT_TRUE(sides.add(0, 3));
  EXPECT_FALSE(sides.apart(0));
  EXPECT_FALSE(sides.apart(119 * kDegree));
  EXPECT_TRUE(sides.apart(120 * kDegree));
  EXPECT_TRUE(sides.apart(-120 * kDegree));
  EXPECT_FALSE(sides.add(105 * kDegree, 3));
  EXPECT_TRUE(sides.add(180 * kDegree, 3));
  EXPECT_EQ(sides.count(), 2);
}

TEST(Sides, BetweenThemTheLeastAngleIsHalved) {
  Sides sides = two_sides();
  sides.add(0, 3);
  EXPECT_FALSE(sides.apart(90 * kDegree));
  for (int again = 0; again < 2; ++again) {
    sides.also_between();
    EXPECT_TRUE(sides.apart(60 * kDegree));
    EXPECT_FALSE(sides.apart(59 * kDegree));
  }
}

TEST(Sides, TheSameSideNeverCountsTwice) {
  Sides sides = two_sides();
  ASSERT_TRUE(sides.add(1, 3));
  EXPECT_FALSE(sides.add(1, 100));
  EXPECT_EQ(sides.count(), 1);
}

TEST(Sides, BearingsWrapAround) {
  Sides sides = two_sides();
  ASSERT_TRUE(sides.add(179.9 * kDegree, 3));
  EXPECT_FALSE(sides.add(-179.9 * kDegree, 3));
  EXPECT_FALSE(sides.apart(-100 * kDegree));
  EXPECT_TRUE(sides.apart(400 * kDegree));
}

}  // namespace
}  // namespace saker::active
