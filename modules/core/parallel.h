#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

/// Work on many items side by side whose results are the same, in the same order, for any number of
/// threads.
namespace saker::core {

/// Threads that run tasks in the order in which they came; the destructor drops those that have not
/// started.
class TaskThreads {
 public:
  explicit TaskThreads(int threads);
  ~TaskThreads();
  TaskThreads(const TaskThreads&) = delete;
  TaskThreads& operator=(const TaskThreads&) = delete;

  void push(std::function<void()> task);

 private:
  void work();

  std::mutex mutex_;
  std::condition_variable changed_;
  bool stopping_ = false;
  std::deque<std::function<void()>> tasks_;
  std::vector<std::thread> threads_;
};

/// For each item of a source: compute side by side, take in order.
///
///     ordered_pipeline(threads, [&] { return reader.next(); },          // std::optional<Item>
///                      [&](const Item& item) { return decode(item); },  // on any thread
///                      [&](Result&& result) { writer.write(result); });
///
/// `next` and `take` run on the calling thread, items and results in the source's order; at most
/// 2 · threads items are held. With one thread everything runs here, one item at a time. What
/// `compute` throws is thrown here when its turn to be taken comes.
template <class Next, class Compute, class Take>
void ordered_pipeline(int threads, Next next, Compute compute, Take take) {
  if (threads <= 1) {
    while (auto item = next()) take(compute(std::move(*item)));
    return;
  }
  using Item = typename std::invoke_result_t<Next>::value_type;
  using Result = std::invoke_result_t<Compute&, Item>;
  std::deque<std::future<Result>> waiting;
  TaskThreads pool(threads);  // destroyed first: its tasks use `compute`
  const auto take_oldest = [&] {
    std::future<Result> oldest = std::move(waiting.front());
    waiting.pop_front();
    take(oldest.get());
  };
  while (auto item = next()) {
    auto task = std::make_shared<std::packaged_task<Result()>>(
        [&compute, held = std::make_shared<Item>(std::move(*item))] {
          return compute(std::move(*held));
        });
    waiting.push_back(task->get_future());
    pool.push([task] { (*task)(); });
    if (waiting.size() >= 2 * static_cast<std::size_t>(threads)) take_oldest();
  }
  while (!waiting.empty()) take_oldest();
}

/// compute(0) … compute(count − 1) as a vector.
template <class Compute>
[[nodiscard]] auto ordered_map(int threads, int count, Compute compute) {
  std::vector<std::invoke_result_t<Compute&, int>> results;
  results.reserve(static_cast<std::size_t>(count));
  int i = 0;
  ordered_pipeline(
      threads, [&] { return i < count ? std::optional<int>(i++) : std::nullopt; },
      [&](int index) { return compute(index); },
      [&](auto&& result) { results.push_back(std::forward<decltype(result)>(result)); });
  return results;
}

}  // namespace saker::core
