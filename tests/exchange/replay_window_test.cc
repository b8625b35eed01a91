#include "saker/exchange/replay_window.h"

#include <gtest/gtest.h>

namespace saker::exchange {
namespace {

TEST(AReplayWindow, TakesEachCounterOnceInAnyOrder) {
  ReplayWindow window;
  for (const std::uint64_t counter : {5, 3, 9, 4, 1}) EXPECT_TRUE(window.take(counter)) << counter;
  for (const std::uint64_t counter : {1, 3, 4, 5, 9}) EXPECT_FALSE(window.take(counter)) << counter;
  EXPECT_TRUE(window.take(2));
  EXPECT_EQ(window.newest(), 9u);
}

TEST(AReplayWindow, RefusesWhatIsTooOldToKnow) {
  ReplayWindow window;
  EXPECT_TRUE(window.take(2000));
  EXPECT_TRUE(window.take(2000 - ReplayWindow::kCounters + 1));
  EXPECT_FALSE(window.take(2000 - ReplayWindow::kCounters));
  EXPECT_TRUE(window.take(1'000'000'000'000));
  EXPECT_FALSE(window.take(2000));
}

TEST(AReplayWindow, GoesOnFromWhatWasKept) {
  ReplayWindow before;
  EXPECT_TRUE(before.take(7) && before.take(5));
  ReplayWindow after(before.newest(), before.taken());
  EXPECT_FALSE(after.take(7));
  EXPECT_FALSE(after.take(5));
  EXPECT_TRUE(after.take(6));
}

}  // namespace
}  // namespace saker::exchange
