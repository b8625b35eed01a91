#include "saker/core/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <future>
#include <memory>
#include <thread>
#include <vector>

namespace saker::core {
namespace {

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

TEST(TaskThreads, TasksStartInTheOrderInWhichTheyCame) {
  std::vector<int> order;
  std::promise<void> last;
  TaskThreads threads(1);
  for (int i = 0; i < 50; ++i) threads.push([&order, i] { order.push_back(i); });
  threads.push([&last] { last.set_value(); });
  last.get_future().wait();
  for (int i = 0; i < 50; ++i) EXPECT_EQ(order.at(static_cast<std::size_t>(i)), i);
}

TEST(TaskThreads, TwoTasksRunAtTheSameTime) {
  std::promise<void> first, second, done;
  TaskThreads threads(2);
  threads.push([&] {
    first.set_value();
    second.get_future().wait();
    done.set_value();
  });
  threads.push([&] {
    first.get_future().wait();
    second.set_value();
  });
  EXPECT_EQ(done.get_future().wait_for(std::chrono::seconds(60)), std::future_status::ready);
}

TEST(TaskThreads, TheEndDropsWhatHasNotStartedAndWaitsForWhatHas) {
  std::atomic<int> ran = 0;
  {
    std::promise<void> started;
    TaskThreads threads(1);
    threads.push([&] {
      started.set_value();
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      ++ran;
    });
    for (int i = 0; i < 100; ++i) threads.push([&] { ++ran; });
    started.get_future().wait();
  }
  EXPECT_EQ(ran, 1);
}

TEST(TaskThreads, WithoutTasksEnd) { EXPECT_NO_THROW(TaskThreads(4)); }

}  // namespace
}  // namespace saker::core
