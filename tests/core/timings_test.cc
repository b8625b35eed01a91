#include "saker/core/timings.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <thread>

namespace saker::core {
namespace {

TEST(Timings, RowsHaveTheStatisticsOfWhatWasAdded) {
  Timings timings;
  for (int i = 100; i >= 0; --i) timings.add("odometry", i * 1e-3, 0.5e-3);
  ASSERT_EQ(timings.rows().size(), 1u);
  const Timings::Row row = timings.rows().front();
  EXPECT_EQ(row.n, 101);
  EXPECT_NEAR(row.median_ms, 50, 1e-9);
  EXPECT_NEAR(row.p95_ms, 95, 1e-9);
  EXPECT_NEAR(row.max_ms, 100, 1e-9);
  EXPECT_NEAR(row.cpu_s, 0.0505, 1e-9);
}

TEST(Timings, StagesAreListedInTheGivenOrderAndOnlyIfTheyRan) {
  Timings timings({"odometry", "segmentation", "slam"});
  timings.add("slam", 1e-3, 1e-3);
  timings.add("odometry", 2e-3, 1e-3);
  EXPECT_EQ(timings.csv(),
            "stage,n,median_ms,p95_ms,max_ms,cpu_s\n"
            "odometry,1,2.000,2.000,2.000,0.001\n"
            "slam,1,1.000,1.000,1.000,0.001\n");
}

TEST(Timings, TimeGivesTheResultAndCountsWhatThrew) {
  Timings timings;
  EXPECT_EQ(timings.time("a", [] { return 7; }), 7);
  timings.time("a", [] {});
  EXPECT_THROW(timings.time("a", [] { throw std::runtime_error("x"); }), std::runtime_error);
  EXPECT_EQ(timings.rows().front().n, 3);
}

TEST(Timings, ASleepIsWallButNotProcessorTime) {
  Timings timings;
  timings.time("sleep", [] { std::this_thread::sleep_for(std::chrono::milliseconds(30)); });
  EXPECT_GE(timings.rows().front().max_ms, 29);
  EXPECT_LT(timings.rows().front().cpu_s, 0.02);
}

TEST(Timings, ALongRunKeepsItsQuantiles) {
  Timings timings;
  const int n = 300'000;
  for (int i = 0; i < n; ++i) timings.add("a", 1e-6 * i, 0);
  const Timings::Row row = timings.rows().front();
  EXPECT_EQ(row.n, n);
  EXPECT_NEAR(row.median_ms, 150, 1);
  EXPECT_NEAR(row.p95_ms, 285, 1);
  EXPECT_NEAR(row.max_ms, 1e-3 * (n - 1), 1e-9);
}

TEST(Timings, ThreadsAddAtTheSameTime) {
  Timings timings;
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&] {
      for (int i = 0; i < 1000; ++i) timings.time("a", [] {});
    });
  }
  for (auto& thread : threads) thread.join();
  EXPECT_EQ(timings.rows().front().n, 4000);
}

}  // namespace
}  // namespace saker::core
