#include "saker/exchange/coded.h"

namespace saker::exchange {
namespace {

constexpr std::uint32_t kTop = 0xFF000000;
constexpr unsigned kTopShift = 24;
constexpr std::uint16_t kMostCount = 20;  // remembers the last forty or so
constexpr unsigned kMostBytes = 10;       // of a number

/// Where the range is parted: what lies up to here is a 1.
std::uint32_t middle(std::uint32_t low, std::uint32_t high, std::uint16_t probability) {
  const std::uint64_t range = high - low;
  return low + static_cast<std::uint32_t>(range * probability >> 16);
}

}  // namespace

/// The mean of what was seen, one half at first; later a mean that forgets.
void Statistics::Bit::learn(bool one) {
  const int target = one ? 0xFFFF : 0;
  const int change = 2 * (target - probability) / (2 * count + 3);
  probability = static_cast<std::uint16_t>(probability + change);
  if (count < kMostCount) ++count;
}

void CodedWriter::byte(std::uint8_t value) {
  code_byte(value, 0);
  place_.next_number();
}

void CodedWriter::varint(std::uint64_t value) {
  unsigned index = 0;
  for (; value >= 0x80; value >>= 7) code_byte(static_cast<std::uint8_t>(value | 0x80), index++);
  code_byte(static_cast<std::uint8_t>(value), index);
  place_.next_number();
}

void CodedWriter::signed_varint(std::int64_t value) {
  varint(static_cast<std::uint64_t>(value) << 1 ^ static_cast<std::uint64_t>(value >> 63));
}

void CodedWriter::code_byte(std::uint8_t value, unsigned index) {
  Statistics::Byte& bits = statistics_.at(place_.of(index));
  unsigned node = 1;
  for (int shift = 7; shift >= 0; --shift) {
    const bool one = (value >> shift & 1) != 0;
    code_bit(one, bits[node].probability);
    bits[node].learn(one);
    node = 2 * node + (one ? 1 : 0);
  }
}

void CodedWriter::code_bit(bool one, std::uint16_t probability) {
  const std::uint32_t mid = middle(low_, high_, probability);
  (one ? high_ : low_) = one ? mid : mid + 1;
  for (; ((low_ ^ high_) & kTop) == 0; low_ <<= 8, high_ = high_ << 8 | 0xFF) {
    bytes_.push_back(static_cast<char>(high_ >> kTopShift));
  }
}

/// One byte that, with zeros behind it, lies within the range: the ends differ in the first byte.
std::string CodedWriter::finish() {
  bytes_.push_back(static_cast<char>((low_ >> kTopShift) + 1));
  return std::move(bytes_);
}

CodedReader::CodedReader(std::string_view bytes, Statistics& statistics)
    : statistics_(statistics), bytes_(bytes) {
  for (std::size_t i = 0; i <= kAhead; ++i) shift();
}

std::uint8_t CodedReader::byte() {
  const std::uint8_t value = decode_byte(0);
  place_.next_number();
  return value;
}

std::uint64_t CodedReader::varint() {
  std::uint64_t value = 0;
  for (unsigned index = 0; index < kMostBytes; ++index) {
    const std::uint8_t next = decode_byte(index);
    value |= static_cast<std::uint64_t>(next & 0x7F) << (7 * index);
    if ((next & 0x80) != 0) continue;
    place_.next_number();
    return value;
  }
  failed_ = true;
  return 0;
}

std::int64_t CodedReader::signed_varint() {
  const std::uint64_t value = varint();
  return static_cast<std::int64_t>(value >> 1 ^ (~(value & 1) + 1));
}

std::uint8_t CodedReader::decode_byte(unsigned index) {
  Statistics::Byte& bits = statistics_.at(place_.of(index));
  unsigned node = 1;
  while (node < bits.size()) {
    const bool one = decode_bit(bits[node].probability);
    bits[node].learn(one);
    node = 2 * node + (one ? 1 : 0);
  }
  return static_cast<std::uint8_t>(node);
}

bool CodedReader::decode_bit(std::uint16_t probability) {
  const std::uint32_t mid = middle(low_, high_, probability);
  const bool one = code_ <= mid;
  (one ? high_ : low_) = one ? mid : mid + 1;
  for (; ((low_ ^ high_) & kTop) == 0; low_ <<= 8, high_ = high_ << 8 | 0xFF) shift();
  return one;
}

void CodedReader::shift() {
  const auto next = at_ < bytes_.size() ? static_cast<std::uint8_t>(bytes_[at_]) : std::uint8_t{0};
  code_ = code_ << 8 | next;
  ++at_;
}

}  // namespace saker::exchange
