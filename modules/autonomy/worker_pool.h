#pragma once

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace saker::autonomy {

/// Runs jobs on threads that each own a Context (stages that are not shared). Jobs start in the
/// order of submission, so a job may wait for the result of an earlier one. Without threads a job
/// runs inside `submit`.
template <class Context>
class WorkerPool {
 public:
  /// \param make  makes a Context; called once a thread (once in all without threads), here.
  WorkerPool(int threads, const std::function<std::unique_ptr<Context>()>& make) {
    for (int i = 0; i < std::max(threads, 1); ++i) contexts_.push_back(make());
    for (int i = 0; i < threads; ++i) {
      threads_.emplace_back([this, context = contexts_[i].get()] { work(*context); });
    }
  }
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  /// Jobs that have not started are dropped; their futures say broken_promise.
  ~WorkerPool() {
    {
      const std::lock_guard lock(mutex_);
      stopping_ = true;
      jobs_.clear();
    }
    changed_.notify_all();
    for (auto& thread : threads_) thread.join();
  }

  template <class Job>
  [[nodiscard]] auto submit(Job job) -> std::shared_future<std::invoke_result_t<Job, Context&>> {
    using Result = std::invoke_result_t<Job, Context&>;
    auto task = std::make_shared<std::packaged_task<Result(Context&)>>(std::move(job));
    auto future = task->get_future().share();
    if (threads_.empty()) {
      (*task)(*contexts_.front());
      return future;
    }
    {
      const std::lock_guard lock(mutex_);
      jobs_.push_back([task](Context& context) { (*task)(context); });
    }
    changed_.notify_one();
    return future;
  }

 private:
  void work(Context& context) {
    while (true) {
      std::function<void(Context&)> job;
      {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [this] { return stopping_ || !jobs_.empty(); });
        if (stopping_) return;
        job = std::move(jobs_.front());
        jobs_.pop_front();
      }
      job(context);
    }
  }

  std::vector<std::unique_ptr<Context>> contexts_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void(Context&)>> jobs_;
  bool stopping_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace saker::autonomy
