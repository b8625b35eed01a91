#include "saker/autonomy/worker_pool.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace saker::autonomy {
namespace {

struct Counter {
  int jobs = 0;
};

std::vector<int> squares(int threads) {
  WorkerPool<Counter> pool(threads, [] { return std::make_unique<Counter>(); });
  std::vector<std::shared_future<int>> futures;
  for (int i = 0; i < 100; ++i) {
    futures.push_back(pool.submit([i](Counter& context) {
      ++context.jobs;
      return i * i;
    }));
  }
  std::vector<int> results;
  for (auto& future : futures) results.push_back(future.get());
  return results;
}

TEST(WorkerPool, GivesTheSameResultsWithAnyNumberOfThreads) {
  const auto inline_results = squares(0);
  EXPECT_EQ(inline_results[7], 49);
  EXPECT_EQ(squares(1), inline_results);
  EXPECT_EQ(squares(3), inline_results);
}

TEST(WorkerPool, LetsAJobWaitForAnEarlierOneOnASingleThread) {
  WorkerPool<Counter> pool(1, [] { return std::make_unique<Counter>(); });
  const auto first = pool.submit([](Counter&) { return 20; });
  const auto second = pool.submit([first](Counter&) { return first.get() + 1; });
  EXPECT_EQ(second.get(), 21);
}

TEST(WorkerPool, CarriesAnExceptionToWhoeverAsksForTheResult) {
  for (const int threads : {0, 1}) {
    WorkerPool<Counter> pool(threads, [] { return std::make_unique<Counter>(); });
    const auto future = pool.submit([](Counter&) -> int { throw std::runtime_error("broken"); });
    EXPECT_THROW((void)future.get(), std::runtime_error);
  }
}

TEST(WorkerPool, EndsWithJobsLeft) {
  std::shared_future<int> left;
  {
    WorkerPool<Counter> pool(1, [] { return std::make_unique<Counter>(); });
    for (int i = 0; i < 1000; ++i) left = pool.submit([i](Counter&) { return i; });
  }
  EXPECT_TRUE(left.valid());
}

}  // namespace
}  // namespace saker::autonomy
