#pragma once

#include <pthread.h>

namespace saker::flight {

/// A mutex whose holder runs at the priority of the highest that waits for it (priority
/// inheritance, pthread_mutexattr_setprotocol(3)): an ordinary thread that is preempted while it
/// holds what guidance waits for is run at guidance's priority until it lets go. Lockable, as
/// std::mutex is. Cost where nobody holds it: one atomic exchange.
class PriorityMutex {
 public:
  PriorityMutex() {
    pthread_mutexattr_t attributes;
    pthread_mutexattr_init(&attributes);
    pthread_mutexattr_setprotocol(&attributes, PTHREAD_PRIO_INHERIT);
    pthread_mutex_init(&mutex_, &attributes);
    pthread_mutexattr_destroy(&attributes);
  }
  ~PriorityMutex() { pthread_mutex_destroy(&mutex_); }
  PriorityMutex(const PriorityMutex&) = delete;
  PriorityMutex& operator=(const PriorityMutex&) = delete;

  void lock() { pthread_mutex_lock(&mutex_); }
  [[nodiscard]] bool try_lock() { return pthread_mutex_trylock(&mutex_) == 0; }
  void unlock() { pthread_mutex_unlock(&mutex_); }

 private:
  pthread_mutex_t mutex_;
};

}  // namespace saker::flight
