#include "saker/lidar/sensor_clock.h"

#include <gtest/gtest.h>

#include <limits>

namespace saker::lidar {
namespace {

constexpr int kColumns = 512;

SensorInfo sensor() { return SensorInfo::make_os1(16, kColumns, PacketProfile::kLegacy); }

Time stamp_of(int frame, int column, Time ahead = 0) {
  return 1'000'000'000'000 + ahead +
         from_seconds((frame * kColumns + column) * sensor().column_period_s());
}

void hear_frame(SensorClock& clock, int frame, int frame_id, Time ahead = 0) {
  for (int column = 15; column < kColumns; column += 16)
    clock.hear(frame_id, column, stamp_of(frame, column, ahead));
}

TEST(SensorClock, AClockThatGoesOnIsNotCorrected) {
  SensorClock clock(sensor());
  for (int frame = 0; frame < 50; ++frame) hear_frame(clock, frame, 65520 + frame);
  EXPECT_EQ(clock.steps(), 0);
  EXPECT_EQ(clock.correction(), 0);
}

TEST(SensorClock, FramesThatWereLostTookTheirTime) {
  SensorClock clock(sensor());
  hear_frame(clock, 0, 0);
  hear_frame(clock, 300, 300);
  EXPECT_EQ(clock.steps(), 0);
}

TEST(SensorClock, AStepIsTakenBackToTheNearestColumn) {
  for (const Time step : {from_seconds(-900), from_seconds(0.4), from_seconds(3e8)}) {
    SensorClock clock(sensor());
    hear_frame(clock, 0, 7);
    hear_frame(clock, 1, 8, step);
    EXPECT_EQ(clock.steps(), 1);
    EXPECT_NEAR(to_seconds(clock.correction() + step), 0, sensor().column_period_s());
    EXPECT_EQ(clock.correction_before(), 0);
  }
}

TEST(SensorClock, OneColumnOutOfTimeIsNoStep) {
  SensorClock clock(sensor());
  hear_frame(clock, 0, 0);
  clock.hear(1, 0, stamp_of(1, 0, from_seconds(5)));
  EXPECT_TRUE(clock.doubted());
  hear_frame(clock, 1, 1);
  EXPECT_EQ(clock.steps(), 0);
  EXPECT_FALSE(clock.doubted());
}

TEST(SensorClock, AfterARestartTimeGoesOnByAFrame) {
  SensorClock clock(sensor());
  hear_frame(clock, 0, 30000);
  for (int column = 15; column < kColumns; column += 16)
    clock.hear(0, column, from_seconds(2 + column * sensor().column_period_s()));
  EXPECT_EQ(clock.steps(), 1);
  const double on =
      to_seconds(from_seconds(2) + clock.correction()) - to_seconds(stamp_of(0, kColumns - 1));
  EXPECT_GT(on, 0);
  EXPECT_LT(on, 0.25);
}

TEST(SensorClock, AnyStampMayCome) {
  SensorClock clock(sensor());
  for (const Time stamp : {std::numeric_limits<Time>::min(), Time{-1}, Time{0},
                           std::numeric_limits<Time>::max(), Time{5}, Time{6}})
    clock.hear(3, 1, stamp);
  EXPECT_LE(clock.steps(), 2);
}

}  // namespace
}  // namespace saker::lidar
