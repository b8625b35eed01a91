#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

/// What stands between two threads: a value of which only the newest counts, or a queue with a
/// ceiling. The locks are held for a swap or a move, never while something is computed or freed.
namespace saker::flight {

/// The latest value. Any number of threads.
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
  mutable std::mutex mutex_;
  std::shared_ptr<const T> value_;
  bool fresh_ = false;
};

/// At most `capacity` values in the order in which they came; the oldest gives way and is counted.
template <class T>
class BoundedQueue {
 public:
  explicit BoundedQueue(std::size_t capacity) : capacity_(capacity > 0 ? capacity : 1) {}

  void push(T value) {
    std::optional<T> oldest;  // freed after the lock
    const std::lock_guard lock(mutex_);
    if (values_.size() == capacity_) {
      oldest.emplace(std::move(values_.front()));
      values_.pop_front();
      ++dropped_;
    }
    values_.push_back(std::move(value));
  }

  [[nodiscard]] std::optional<T> pop() {
    const std::lock_guard lock(mutex_);
    if (values_.empty()) return std::nullopt;
    std::optional<T> value(std::move(values_.front()));
    values_.pop_front();
    return value;
  }

  /// All of them, oldest first.
  [[nodiscard]] std::vector<T> take_all() {
    std::deque<T> values;
    {
      const std::lock_guard lock(mutex_);
      values.swap(values_);
    }
    return {std::make_move_iterator(values.begin()), std::make_move_iterator(values.end())};
  }

  [[nodiscard]] std::size_t size() const {
    const std::lock_guard lock(mutex_);
    return values_.size();
  }
  [[nodiscard]] long dropped() const {
    const std::lock_guard lock(mutex_);
    return dropped_;
  }

 private:
  const std::size_t capacity_;
  mutable std::mutex mutex_;
  std::deque<T> values_;
  long dropped_ = 0;
};

}  // namespace saker::flight
