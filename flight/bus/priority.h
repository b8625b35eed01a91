#pragma once

#include <pthread.h>

#include <string>

namespace saker::flight {

/// Gives the calling thread a real-time priority (SCHED_FIFO), 1 … 99. Empty, or one line that says
/// why it was not granted.
[[nodiscard]] std::string take_priority(int priority);

/// A real-time priority of the calling thread while this lives, where it is granted. Threads that
/// are made meanwhile inherit it and keep it.
class RaisedPriority {
 public:
  explicit RaisedPriority(int priority);
  ~RaisedPriority();
  RaisedPriority(const RaisedPriority&) = delete;
  RaisedPriority& operator=(const RaisedPriority&) = delete;

  [[nodiscard]] bool granted() const { return granted_; }

 private:
  int policy_ = 0;
  sched_param parameters_{};
  bool granted_ = false;
};

}  // namespace saker::flight
