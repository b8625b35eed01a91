#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>

/// Numbers in byte strings as in bytes.h, in two thirds of the bytes: what is usual costs little.
///
/// Method: adaptive binary arithmetic coding; every bit of a number is told by the probability
/// that it had so far in the same place, as both ends have counted it. Whole numbers only, so that
/// all machines agree. Source: Witten, Neal, Cleary, "Arithmetic coding for data compression",
/// 1987; the carryless coder and counters as in Mahoney, "Adaptive weighing of context models for
/// lossless data compression", 2005.
namespace saker::exchange {

/// What was learnt from all that was coded before: the other end has to have read the same.
class Statistics {
 public:
  /// Of a bit that is 1: in 65536ths, never 0 nor all of them.
  struct Bit {
    std::uint16_t probability = 1 << 15;
    std::uint16_t count = 0;
    void learn(bool one);
  };
  /// Of a byte: its bits by those above them.
  using Byte = std::array<Bit, 256>;

  [[nodiscard]] Byte& at(std::uint64_t place) { return places_[place]; }

 private:
  std::unordered_map<std::uint64_t, Byte> places_;
};

/// Where a byte stands: the part of the message, the number in this part, the byte in the number.
class Place {
 public:
  void begin(unsigned part) {
    part_ = part;
    number_ = 0;
  }
  void next_number() { ++number_; }
  [[nodiscard]] std::uint64_t of(unsigned byte) const {
    return static_cast<std::uint64_t>(part_) << 32 | static_cast<std::uint64_t>(number_) << 4 |
           byte;
  }

 private:
  std::uint32_t part_ = 0, number_ = 0;
};

class CodedWriter {
 public:
  explicit CodedWriter(Statistics& statistics) : statistics_(statistics) {}

  /// Numbers from here on are compared with those that followed the same `part` before.
  void part(unsigned which) { place_.begin(which); }
  void byte(std::uint8_t value);
  void varint(std::uint64_t value);
  void signed_varint(std::int64_t value);

  /// All of it; nothing can be written afterwards.
  [[nodiscard]] std::string finish();

 private:
  void code_byte(std::uint8_t value, unsigned index);
  void code_bit(bool one, std::uint16_t probability);

  Statistics& statistics_;
  Place place_;
  std::string bytes_;
  std::uint32_t low_ = 0, high_ = 0xFFFFFFFF;
};

/// Reading past the end gives numbers that mean nothing and `failed`, for good.
class CodedReader {
 public:
  CodedReader(std::string_view bytes, Statistics& statistics);

  void part(unsigned which) { place_.begin(which); }
  [[nodiscard]] std::uint8_t byte();
  [[nodiscard]] std::uint64_t varint();
  [[nodiscard]] std::int64_t signed_varint();

  [[nodiscard]] bool failed() const { return failed_ || at_ > bytes_.size() + kAhead; }
  /// Nothing is left, and nothing was missing.
  [[nodiscard]] bool done() const { return !failed_ && at_ == bytes_.size() + kAhead; }

 private:
  static constexpr std::size_t kAhead = 3;  // bytes that the code holds beyond what it tells

  [[nodiscard]] std::uint8_t decode_byte(unsigned index);
  [[nodiscard]] bool decode_bit(std::uint16_t probability);
  void shift();

  Statistics& statistics_;
  Place place_;
  std::string_view bytes_;
  std::size_t at_ = 0;
  std::uint32_t low_ = 0, high_ = 0xFFFFFFFF, code_ = 0;
  bool failed_ = false;
};

}  // namespace saker::exchange
