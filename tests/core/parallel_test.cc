#include "saker/core/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <memory>
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

}  // namespace
}  // namespace saker::core
