#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>
#include <type_traits>

namespace saker::lidar {

using ByteView = std::span<const std::uint8_t>;

/// Reads numbers from bytes that somebody else wrote, and never past their end: a read that does
/// not fit gives zero, and `ok` is false from then on.
class Cursor {
 public:
  explicit Cursor(ByteView bytes, bool big_endian = false)
      : bytes_(bytes), big_endian_(big_endian) {}

  [[nodiscard]] bool ok() const { return ok_; }
  [[nodiscard]] std::size_t at() const { return at_; }
  [[nodiscard]] std::size_t left() const { return bytes_.size() - at_; }

  template <class T>
  T number() {
    static_assert(std::is_arithmetic_v<T>);
    const ByteView from = take(sizeof(T));
    std::uint8_t raw[sizeof(T)] = {};
    std::copy(from.begin(), from.end(), raw);
    if (big_endian_) std::reverse(raw, raw + sizeof(T));
    return std::bit_cast<T>(raw);
  }

  /// The next bytes; empty where there are fewer.
  ByteView take(std::size_t count) {
    if (count > left()) {
      ok_ = false;
      return {};
    }
    const ByteView taken = bytes_.subspan(at_, count);
    at_ += count;
    return taken;
  }

  /// As many as there are, at most `count`.
  ByteView take_at_most(std::size_t count) { return take(std::min(count, left())); }

  void skip(std::size_t count) { (void)take(count); }

  /// Moves on to a multiple of `step` from the beginning.
  void align(std::size_t step) { skip((step - at_ % step) % step); }

 private:
  ByteView bytes_;
  std::size_t at_ = 0;
  bool big_endian_ = false;
  bool ok_ = true;
};

[[nodiscard]] inline std::string_view text_of(ByteView bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace saker::lidar
