#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "flight/bus/priority_mutex.h"

/// What stands between two threads: a value of which only the newest counts, or a queue with a
/// ceiling. The locks are held for a swap, a move or the copy of a small value, never while
/// something is computed or freed, and lend their holder the priority of who waits.
namespace saker::flight {

/// The latest value, shared. Any number of threads.
template <class T>
class Mailbox {
 public:
  void put(T value) { put(std::make_shared<const T>(std::move(value))); }
  void put(std::shared_ptr<const T> value) {
    const std::lock_guard lock(mutex_);
    value_.swap(value);  // the old one is freed by the caller's copy, after the lock
    fresh_ = true;
  }

  /// Null before the first one.
  [[nodiscard]] std::shared_ptr<const T> latest() const {
    const std::lock_guard lock(mutex_);
    return value_;
  }

  /// The latest one, if it came since the last `take`; else null.
  [[nodiscard]] std::shared_ptr<const T> take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(fresh_, false) ? value_ : nullptr;
  }

 private:
  mutable PriorityMutex mutex_;
  std::shared_ptr<const T> value_;
  bool fresh_ = false;
};

/// The latest value, by copy: for what guidance and safety read and write, which allocate and free
/// nothing. A T that is small and has no memory of its own.
template <class T>
class ValueBox {
 public:
  void put(const T& value) {
    const std::lock_guard lock(mutex_);
    value_ = value;
  }
  void clear() {
    const std::lock_guard lock(mutex_);
    value_.reset();
  }

  /// Nothing before the first one.
  [[nodiscard]] std::optional<T> latest() const {
    const std::lock_guard lock(mutex_);
    return value_;
  }

 private:
  mutable PriorityMutex mutex_;
  std::optional<T> value_;
};

/// At most `capacity` values in the order in which they came; the oldest gives way and is counted.
/// A ring that grows by doubling: once it has been as full as it gets, nothing is allocated.
template <class T>
class BoundedQueue {
 public:
  explicit BoundedQueue(std::size_t capacity)
      : capacity_(std::max<std::size_t>(capacity, 1)), slots_(std::min(capacity_, kFirst)) {}

  void push(T value) {
    std::optional<T> oldest;  // freed after the lock
    const std::lock_guard lock(mutex_);
    if (size_ == capacity_) {
      oldest = take_first();
      ++dropped_;
    }
    if (size_ == slots_.size()) grow();
    slots_[(first_ + size_++) % slots_.size()].emplace(std::move(value));
  }

  [[nodiscard]] std::optional<T> pop() {
    const std::lock_guard lock(mutex_);
    return size_ == 0 ? std::nullopt : take_first();
  }

  /// All of them, oldest first.
  [[nodiscard]] std::vector<T> take_all() {
    std::vector<T> values;
    values.reserve(size());
    for (auto value = pop(); value; value = pop()) {
      values.push_back(std::move(*value));
      if (values.size() == capacity_) break;  // who pushes as fast as this takes is not waited for
    }
    return values;
  }

  [[nodiscard]] std::size_t size() const {
    const std::lock_guard lock(mutex_);
    return size_;
  }
  [[nodiscard]] long dropped() const {
    const std::lock_guard lock(mutex_);
    return dropped_;
  }

 private:
  static constexpr std::size_t kFirst = 64;

  [[nodiscard]] std::optional<T> take_first() {
    std::optional<T> value = std::exchange(slots_[first_], std::nullopt);
    first_ = (first_ + 1) % slots_.size();
    --size_;
    return value;
  }
  void grow() {
    std::vector<std::optional<T>> more(std::min(capacity_, 2 * slots_.size()));
    for (std::size_t i = 0; i < size_; ++i)
      more[i] = std::move(slots_[(first_ + i) % slots_.size()]);
    slots_.swap(more);
    first_ = 0;
  }

  const std::size_t capacity_;
  mutable PriorityMutex mutex_;
  std::vector<std::optional<T>> slots_;
  std::size_t first_ = 0, size_ = 0;
  long dropped_ = 0;
};

}  // namespace saker::flight
