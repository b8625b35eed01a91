#include "saker/autonomy/schedule.h"

#include <gtest/gtest.h>

namespace saker::autonomy {
namespace {

int count_due(Schedule schedule, Time period, int scans) {
  int due = 0;
  for (int i = 0; i < scans; ++i) due += schedule.due(i * period) ? 1 : 0;
  return due;
}

TEST(Schedule, TakesTheFirstStamp) { EXPECT_TRUE(Schedule(2).due(123456789)); }

TEST(Schedule, TakesEveryOtherScanOfTenHertzAtFive) {
  EXPECT_EQ(count_due(Schedule(5), from_seconds(0.1), 100), 50);
}

TEST(Schedule, HoldsTheRateOnAverageWhenItDoesNotDivideTheScans) {
  EXPECT_NEAR(count_due(Schedule(3), from_seconds(0.1), 1000), 300, 1);
}

TEST(Schedule, TakesEveryScanWhenItIsFasterThanTheSensor) {
  EXPECT_EQ(count_due(Schedule(20), from_seconds(0.1), 100), 100);
}

TEST(Schedule, DoesNotMakeUpForAGap) {
  Schedule schedule(5);
  EXPECT_TRUE(schedule.due(0));
  EXPECT_TRUE(schedule.due(from_seconds(10)));
  EXPECT_FALSE(schedule.due(from_seconds(10.1)));
  EXPECT_TRUE(schedule.due(from_seconds(10.2)));
}

TEST(Schedule, AcceptsAScanThatJitterBringsALittleEarly) {
  Schedule schedule(5);
  EXPECT_TRUE(schedule.due(0));
  EXPECT_TRUE(schedule.due(from_seconds(0.199)));
}

}  // namespace
}  // namespace saker::autonomy
