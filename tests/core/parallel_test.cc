#include "core/parallel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <numeric>
#include <stdexcept>

namespace saker::core {
namespace {

class ParallelTest : public testing::TestWithParam<int> {};

TEST_P(ParallelTest, ResultsComeInTheOrderOfTheItems) {
  const auto squares = ordered_map(GetParam(), 500, [](int i) { return i * i; });
  ASSERT_EQ(squares.size(), 500u);
  for (int i = 0; i < 500; ++i) EXPECT_EQ(squares[i], i * i);
}

TEST_P(ParallelTest, ItemsHeldAreBounded) {
  int read = 0, taken = 0, most = 0;
  ordered_pipeline(
      GetParam(), [&] { return read < 200 ? std::optional<int>(read++) : std::nullopt; },
      [](int item) { return item; },
      [&](int) {
        most = std::max(most, read - taken);
        ++taken;
      });
  EXPECT_EQ(taken, 200);
  EXPECT_LE(most, 2 * std::max(GetParam(), 1));
}

TEST_P(ParallelTest, AnExceptionArrivesAtItsTurn) {
  std::vector<int> taken;
  int next = 0;
  const auto run = [&] {
    ordered_pipeline(
        GetParam(), [&] { return next < 100 ? std::optional<int>(next++) : std::nullopt; },
        [](int item) {
          if (item == 7) throw std::runtime_error("seven");
          return item;
        },
        [&](int result) { taken.push_back(result); });
  };
  EXPECT_THROW(run(), std::runtime_error);
  std::vector<int> expected(7);
  std::iota(expected.begin(), expected.end(), 0);
  EXPECT_EQ(taken, expected);
}

TEST_P(ParallelTest, NoItemsNoResults) {
  EXPECT_TRUE(ordered_map(GetParam(), 0, [](int i) { return i; }).empty());
}

INSTANTIATE_TEST_SUITE_P(Threads, ParallelTest, testing::Values(0, 1, 2, 5));

TEST(TaskThreads, EveryTaskRunsOnce) {
  std::atomic<int> sum = 0;
  std::vector<std::future<void>> done;
  TaskThreads threads(3);
  for (int i = 1; i <= 100; ++i) {
    auto task = std::make_shared<std::packaged_task<void()>>([&sum, i] { sum += i; });
    done.push_back(task->get_future());
    threads.push([task] { (*task)(); });
  }
  for (auto& d : done) d.get();
  EXPECT_EQ(sum, 5050);
}

}  // namespace
}  // namespace saker::core
