#include "saker/core/time.h"

#include <gtest/gtest.h>

namespace saker {
namespace {

TEST(Time, IsInNanoseconds) {
  EXPECT_EQ(from_seconds(1), kNanosecondsPerSecond);
  EXPECT_EQ(from_seconds(0.1), 100'000'000);
  EXPECT_EQ(from_seconds(0), 0);
  EXPECT_DOUBLE_EQ(to_seconds(2'500'000'000), 2.5);
}

TEST(Time, IsRoundedToTheNearestNanosecondOnBothSidesOfZero) {
  EXPECT_EQ(from_seconds(1.4e-9), 1);
  EXPECT_EQ(from_seconds(1.6e-9), 2);
  EXPECT_EQ(from_seconds(-1.4e-9), -1);
  EXPECT_EQ(from_seconds(-1.6e-9), -2);
}

TEST(Time, SurvivesTheWayThroughSeconds) {
  for (const Time time : {Time{1}, Time{-7}, Time{123'456'789}, Time{3'600'000'000'001}}) {
    EXPECT_EQ(from_seconds(to_seconds(time)), time);
    EXPECT_EQ(from_seconds(-to_seconds(time)), -time);
  }
}

TEST(Time, OfAWholeDayIsExactToTheNanosecond) {
  constexpr Time kDay = 86'400 * kNanosecondsPerSecond;
  EXPECT_EQ(from_seconds(to_seconds(kDay + 1)) - kDay, 1);
}

}  // namespace
}  // namespace saker
