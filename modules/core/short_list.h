#pragma once

#include <array>
#include <cstddef>
#include <iterator>
#include <utility>

namespace saker::core {

/// Up to kMost values in their order, without memory of their own; used as std::vector is. What
/// comes when it is full is dropped and counted.
template <class T, std::size_t kMost>
class ShortList {
 public:
  ShortList() = default;
  /// Of a vector, or whatever has a begin and an end.
  template <class Range>
  requires requires(const Range& range) { std::begin(range) != std::end(range); }
  ShortList(const Range& range) {
    for (const auto& value : range) push_back(value);
  }

  void push_back(T value) {
    if (size_ == kMost) {
      ++dropped_;
    } else {
      values_[size_++] = std::move(value);
    }
  }
  void clear() { size_ = 0; }

  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] std::size_t dropped() const { return dropped_; }
  [[nodiscard]] const T* data() const { return values_.data(); }
  [[nodiscard]] const T* begin() const { return values_.data(); }
  [[nodiscard]] const T* end() const { return values_.data() + size_; }
  [[nodiscard]] const T& front() const { return values_.front(); }
  [[nodiscard]] const T& back() const { return values_[size_ - 1]; }
  [[nodiscard]] const T& operator[](std::size_t i) const { return values_[i]; }

 private:
  std::array<T, kMost> values_;
  std::size_t size_ = 0, dropped_ = 0;
};

}  // namespace saker::core
