#pragma once

#include <algorithm>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <vector>

#include "saker/core/parallel.h"

namespace saker::autonomy {

/// Runs jobs on threads, each with a Context of its own for as long as it runs (stages that are not
/// shared; which one it gets must not matter). Jobs start in the order of submission, so a job may
/// wait for the result of an earlier one. Without threads a job runs inside `submit`. Jobs that
/// have not started at the end are dropped.
template <class Context>
class WorkerPool {
 public:
  /// \param make  makes a Context; called here, once a thread (once in all without threads).
  WorkerPool(int threads, const std::function<std::unique_ptr<Context>()>& make) {
    for (int i = 0; i < std::max(threads, 1); ++i) contexts_.push_back(make());
    if (threads > 0) threads_ = std::make_unique<core::TaskThreads>(threads);
  }

  template <class Job>
  [[nodiscard]] auto submit(Job job) -> std::shared_future<std::invoke_result_t<Job, Context&>> {
    using Result = std::invoke_result_t<Job, Context&>;
    auto task = std::make_shared<std::packaged_task<Result()>>([this, job = std::move(job)] {
      const Lease lease(*this);
      return job(*lease.context);
    });
    auto future = task->get_future().share();
    if (threads_ != nullptr) {
      threads_->push([task] { (*task)(); });
    } else {
      (*task)();
    }
    return future;
  }

 private:
  struct Lease {
    explicit Lease(WorkerPool& owner) : pool(owner) {
      const std::lock_guard lock(pool.mutex_);
      context = std::move(pool.contexts_.back());  // there are as many as threads
      pool.contexts_.pop_back();
    }
    ~Lease() {
      const std::lock_guard lock(pool.mutex_);
      pool.contexts_.push_back(std::move(context));
    }
    Lease(const Lease&) = delete;
    Lease& operator=(const Lease&) = delete;

    WorkerPool& pool;
    std::unique_ptr<Context> context;
  };

  std::mutex mutex_;
  std::vector<std::unique_ptr<Context>> contexts_;
  std::unique_ptr<core::TaskThreads> threads_;  // last: its tasks use what stands above
};

}  // namespace saker::autonomy
