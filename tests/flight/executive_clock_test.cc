#include <gtest/gtest.h>

#include "flight/executive/shared_clock.h"

namespace saker::flight {
namespace {

using std::chrono::milliseconds;

constexpr Time kMillisecond = kNanosecondsPerSecond / 1000;
const SharedClock::Steady::time_point kBegin{std::chrono::hours(1)};

/// A sensor that stamps every 10 ms; each stamp comes `late_ms` later.
class ExecutiveClock : public testing::Test {
 protected:
  void pass(double seconds, int late_ms) {
    for (int i = 0; i < static_cast<int>(100 * seconds); ++i) {
      stamp += 10 * kMillisecond;
      steady += milliseconds(10);
      clock.hear(stamp, steady + milliseconds(late_ms));
      const Time now = clock.now(steady + milliseconds(late_ms));
      largest_step = std::max(largest_step, now - last);
      least_step = std::min(least_step, now - last);
      last = now;
    }
  }
  double error_ms(int late_ms) const {
    return static_cast<double>(clock.now(steady + milliseconds(late_ms)) - stamp) / kMillisecond;
  }
  void watch_steps() {
    largest_step = 0;
    least_step = kNanosecondsPerSecond;
  }

  SharedClock clock;
  Time stamp = 500 * kNanosecondsPerSecond;
  SharedClock::Steady::time_point steady = kBegin;
  Time last = 0, largest_step = 0, least_step = kNanosecondsPerSecond;
};

TEST_F(ExecutiveClock, IsZeroBeforeTheFirstStamp) { EXPECT_EQ(clock.now(kBegin), 0); }

TEST_F(ExecutiveClock, TheLeastLateStampCounts) {
  pass(1, 2);
  for (int i = 0; i < 50; ++i) {
    pass(0.01, 40);
    pass(0.01, 2);
  }
  EXPECT_NEAR(error_ms(2), 0, 1);
}

TEST_F(ExecutiveClock, FollowsASensorThatFellBehindWithoutAJump) {
  pass(3, 2);
  watch_steps();
  pass(0.01, 302);  // and stays so late
  const Time jump = 300 * kMillisecond;
  EXPECT_LE(largest_step, 10 * kMillisecond + jump);  // that long nothing was heard
  watch_steps();
  pass(8, 302);
  EXPECT_NEAR(error_ms(302), 0, 1);
  EXPECT_GE(least_step, 9 * kMillisecond - 1);
  EXPECT_LE(largest_step, 11 * kMillisecond + 1);
}

TEST_F(ExecutiveClock, GoesOnWhileNothingIsHeard) {
  pass(3, 2);
  const Time at = clock.now(steady);
  EXPECT_EQ(clock.now(steady + milliseconds(700)) - at, 700 * kMillisecond);
}

// It jumped to whatever one sample said: the age of everything with it.
TEST_F(ExecutiveClock, OneStampFarOffMovesNothing) {
  pass(3, 2);
  for (const Time far : {stamp + 3600 * kNanosecondsPerSecond, Time{0}, Time{1} << 61})
    clock.hear(far, steady);
  EXPECT_NEAR(error_ms(2), 0, 1);
  pass(1, 2);
  EXPECT_NEAR(error_ms(2), 0, 1);
}

}  // namespace
}  // namespace saker::flight
