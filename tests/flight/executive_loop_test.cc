#include <gtest/gtest.h>

#include <atomic>
#include <new>
#include <stdexcept>
#include <thread>

#include "flight/executive/loop.h"
#include "flight/executive/stage_timings.h"

namespace saker::flight {
namespace {

using std::chrono::milliseconds;

TEST(ExecutiveLoop, RunsAtItsRateUntilItIsStopped) {
  std::atomic<int> runs = 0;
  Loop loop("test", 100, 0, [&] {
    ++runs;
    return LoopStatus{};
  });
  loop.start();
  std::this_thread::sleep_for(milliseconds(500));
  loop.stop();
  const int at_stop = runs;
  EXPECT_GT(at_stop, 25);
  EXPECT_LE(at_stop, 52);
  std::this_thread::sleep_for(milliseconds(50));
  EXPECT_EQ(runs, at_stop);
}

TEST(ExecutiveLoop, CountsALateRunAndDoesNotMakeUpForIt) {
  std::atomic<int> runs = 0;
  Loop loop("test", 100, 0, [&] {
    if (++runs == 5) std::this_thread::sleep_for(milliseconds(300));
    return LoopStatus{12, 3};
  });
  loop.start();
  std::this_thread::sleep_for(milliseconds(1300));
  loop.stop();
  EXPECT_LE(runs, 104);  // thirty were lost
  const auto health = loop.health();
  ASSERT_NE(health, nullptr);
  EXPECT_EQ(health->name, "test");
  EXPECT_GE(health->misses, 1);
  EXPECT_EQ(health->age_ms, 12);
  EXPECT_EQ(health->drops, 3);
  EXPECT_EQ(loop.totals().runs, runs);
  EXPECT_GE(loop.totals().worst_lateness_ms, 250);
}

TEST(ExecutiveLoop, HangsWhenNoRunEndsForASecondAndTenPeriods) {
  std::atomic<bool> held = false;
  Loop loop("test", 50, 0, [&] {
    while (held) std::this_thread::sleep_for(milliseconds(1));
    return LoopStatus{};
  });
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_FALSE(loop.hangs(begin + std::chrono::hours(1)));  // not started
  loop.start();
  std::this_thread::sleep_for(milliseconds(200));
  held = true;
  std::this_thread::sleep_for(milliseconds(100));
  EXPECT_FALSE(loop.hangs(begin + milliseconds(1100)));
  EXPECT_TRUE(loop.hangs(begin + milliseconds(1400)));
  held = false;
}

TEST(ExecutiveLoop, ASlowLoopMayTakeLonger) {
  Loop loop("test", 1, 0, [] { return LoopStatus{}; });
  loop.start();
  std::this_thread::sleep_for(milliseconds(100));
  const auto now = std::chrono::steady_clock::now();
  EXPECT_FALSE(loop.hangs(now + std::chrono::seconds(9)));
  EXPECT_TRUE(loop.hangs(now + std::chrono::seconds(11)));
}

TEST(ExecutiveLoop, StopsWithoutHavingStarted) {
  Loop loop("test", 1, 0, [] { return LoopStatus{}; });
  loop.stop();
  EXPECT_EQ(loop.health(), nullptr);
}

TEST(ExecutiveLoop, ARunThatThrowsIsCountedAndTheNextOneBegins) {
  std::atomic<int> runs = 0;
  Loop loop("test", 100, 0, [&]() -> LoopStatus {
    if (++runs % 2 == 0) throw std::bad_alloc();
    return {};
  });
  loop.start();
  std::this_thread::sleep_for(milliseconds(300));
  loop.stop();
  EXPECT_GT(runs, 10);
  EXPECT_EQ(loop.faults().throws, runs / 2);
  EXPECT_EQ(loop.faults().last, "std::bad_alloc");
  EXPECT_FALSE(loop.faults().off);
}

TEST(ExecutiveLoop, IsSwitchedOffAfterSoManyThrowsInARow) {
  std::atomic<int> runs = 0;
  Loop loop(
      "test", 100, 0,
      [&]() -> LoopStatus {
        if (++runs != 2) throw std::runtime_error("broken");
        return {};
      },
      3);
  loop.start();
  std::this_thread::sleep_for(milliseconds(1300));
  EXPECT_FALSE(loop.hangs(Loop::Steady::now()));  // it says that it is off, and lives
  loop.stop();
  EXPECT_EQ(runs, 5);  // a throw, one that was well, three in a row
  EXPECT_EQ(loop.faults().throws, 4);
  EXPECT_TRUE(loop.faults().off);
  EXPECT_NE(loop.health(), nullptr);
}

TEST(ExecutiveLoop, WithoutALimitIsTriedForEverWhateverIsThrown) {
  std::atomic<int> runs = 0;
  Loop loop("test", 100, 0, [&]() -> LoopStatus { throw ++runs; });
  loop.start();
  std::this_thread::sleep_for(milliseconds(300));
  loop.stop();
  EXPECT_GT(runs, 10);
  EXPECT_EQ(loop.faults().throws, runs);
  EXPECT_EQ(loop.faults().last, "no std::exception");
}

TEST(ExecutiveLoop, IsNotWaitedForLongerThanItIsGiven) {
  std::atomic<bool> held = true;
  Loop loop("test", 100, 0, [&] {
    while (held) std::this_thread::sleep_for(milliseconds(1));
    return LoopStatus{};
  });
  loop.start();
  std::this_thread::sleep_for(milliseconds(50));
  const auto begin = Loop::Steady::now();
  EXPECT_FALSE(loop.stop(milliseconds(200)));
  EXPECT_LT(Loop::Steady::now() - begin, milliseconds(2000));
  EXPECT_TRUE(loop.running());
  held = false;
  EXPECT_TRUE(loop.stop());
  EXPECT_FALSE(loop.running());
}

/// The real-time stage and the ordinary ones have no lock in common, and one table.
TEST(ExecutiveLoop, TimesOfIngestionAreApartAndInTheSameTable) {
  StageTimings timings;
  timings.ordinary.add("planning", 0.002, 0.001);
  timings.ingestion.add("odometry", 0.004, 0.003);
  timings.ordinary.add("segmentation", 0.001, 0.001);
  EXPECT_EQ(timings.ordinary.rows().size(), 2u);
  EXPECT_EQ(timings.ingestion.rows().size(), 1u);
  EXPECT_EQ(timings.csv(),
            "stage,n,median_ms,p95_ms,max_ms,cpu_s\n"
            "odometry,1,4.000,4.000,4.000,0.003\n"
            "segmentation,1,1.000,1.000,1.000,0.001\n"
            "planning,1,2.000,2.000,2.000,0.001\n");
}

}  // namespace
}  // namespace saker::flight
