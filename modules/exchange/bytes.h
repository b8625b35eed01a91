#pragma once

#include <cstdint>
#include <string>
#include <string_view>

/// Numbers in byte strings: little-endian, and variable-length ones (LEB128; signed ones zigzag).
namespace saker::exchange {

class ByteWriter {
 public:
  void byte(std::uint8_t value) { bytes_.push_back(static_cast<char>(value)); }
  template <class Unsigned>
  void fixed(Unsigned value) {
    for (std::size_t i = 0; i < sizeof(Unsigned); ++i) {
      byte(static_cast<std::uint8_t>(value >> (8 * i)));
    }
  }
  void varint(std::uint64_t value) {
    for (; value >= 0x80; value >>= 7) byte(static_cast<std::uint8_t>(value | 0x80));
    byte(static_cast<std::uint8_t>(value));
  }
  void signed_varint(std::int64_t value) {
    varint(static_cast<std::uint64_t>(value) << 1 ^ static_cast<std::uint64_t>(value >> 63));
  }
  /// Its length first.
  void text(std::string_view value) {
    varint(value.size());
    bytes_.append(value);
  }
  void raw(std::string_view value) { bytes_.append(value); }

  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

/// Reading past the end gives zeros and `failed`, for good.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

  [[nodiscard]] std::uint8_t byte() {
    if (at_ >= bytes_.size()) return fail();
    return static_cast<std::uint8_t>(bytes_[at_++]);
  }
  template <class Unsigned>
  [[nodiscard]] Unsigned fixed() {
    Unsigned value = 0;
    for (std::size_t i = 0; i < sizeof(Unsigned); ++i) {
      value = static_cast<Unsigned>(value | static_cast<Unsigned>(byte()) << (8 * i));
    }
    return value;
  }
  [[nodiscard]] std::uint64_t varint() {
    std::uint64_t value = 0;
    for (int shift = 0; shift < 64; shift += 7) {
      const std::uint8_t next = byte();
      value |= static_cast<std::uint64_t>(next & 0x7F) << shift;
      if ((next & 0x80) == 0) return value;
    }
    return fail();
  }
  [[nodiscard]] std::int64_t signed_varint() {
    const std::uint64_t value = varint();
    return static_cast<std::int64_t>(value >> 1 ^ (~(value & 1) + 1));
  }
  [[nodiscard]] std::string_view text() { return raw(varint()); }
  [[nodiscard]] std::string_view raw(std::uint64_t count) {
    if (count > rest()) {
      fail();
      return {};
    }
    at_ += count;
    return bytes_.substr(at_ - count, count);
  }

  [[nodiscard]] std::size_t at() const { return at_; }
  [[nodiscard]] std::size_t rest() const { return bytes_.size() - at_; }
  [[nodiscard]] bool failed() const { return failed_; }
  /// Nothing is left, and nothing was missing.
  [[nodiscard]] bool done() const { return !failed_ && rest() == 0; }

 private:
  std::uint8_t fail() {
    failed_ = true;
    at_ = bytes_.size();
    return 0;
  }

  std::string_view bytes_;
  std::size_t at_ = 0;
  bool failed_ = false;
};

}  // namespace saker::exchange
