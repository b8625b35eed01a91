#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <utility>

#include "saker/core/time.h"

namespace saker::autonomy {

/// Results on their way: computed at once, there only at `due`, as in real time. In order; holds
/// what is computed within one latency.
template <class T>
class Delayed {
 public:
  void push(Time due, T value) { waiting_.emplace_back(due, std::move(value)); }

  [[nodiscard]] std::optional<T> take(Time now) {
    if (waiting_.empty() || waiting_.front().first > now) return std::nullopt;
    std::optional<T> value(std::move(waiting_.front().second));
    waiting_.pop_front();
    return value;
  }

  [[nodiscard]] std::size_t size() const { return waiting_.size(); }

 private:
  std::deque<std::pair<Time, T>> waiting_;
};

}  // namespace saker::autonomy
