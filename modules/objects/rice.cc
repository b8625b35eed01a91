#include "saker/objects/rice.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <utility>

#include "saker/core/error.h"

namespace saker::objects {
namespace {

constexpr int kWord = 64;             ///< bits
constexpr int kEscape = 32;           ///< zeros that say: 64 bits as they are follow
constexpr int kLowBitsWidth = 6;      ///< of the number of low bits, 0 … 63
constexpr int kLengthWidth = 7;       ///< of the length of a centre, 0 … 64
constexpr int kTextWidth = 32;        ///< of the length of a text
constexpr std::size_t kPadding = 16;  ///< bytes behind the end that a window may touch

std::uint64_t folded(std::uint64_t difference) {
  return (difference << 1) ^ (0 - (difference >> (kWord - 1)));
}

std::uint64_t unfolded(std::uint64_t value) { return (value >> 1) ^ (0 - (value & 1U)); }

struct Code {
  bool fold = false;
  std::int64_t centre = 0;
  int low_bits = 0;
  std::uint64_t cost = 0;  ///< bits of all numbers
  std::vector<std::uint64_t> distances;
};

std::uint64_t cost_of(const std::vector<std::uint64_t>& distances, int low_bits) {
  std::uint64_t sum = 0;
  for (const std::uint64_t distance : distances) {
    sum += std::min<std::uint64_t>(distance >> low_bits, kEscape + kWord);
  }
  return sum + distances.size() * static_cast<std::uint64_t>(low_bits + 1);
}

/// The best number of low bits is near the logarithm of the mean distance.
Code code_of(std::span<const std::int64_t> values, bool fold, std::int64_t centre) {
  Code code{.fold = fold, .centre = centre, .low_bits = 0, .cost = UINT64_MAX, .distances = {}};
  code.distances.reserve(values.size());
  double sum = 0;
  for (const std::int64_t value : values) {
    const auto d = static_cast<std::uint64_t>(value) - static_cast<std::uint64_t>(centre);
    code.distances.push_back(fold ? folded(d) : d);
    sum += static_cast<double>(code.distances.back());
  }
  const double mean = sum / static_cast<double>(values.size());
  const int near = mean < 1 ? 0 : std::min(std::ilogb(mean), kWord - 2);
  for (int low_bits = std::max(0, near - 1); low_bits <= near + 1; ++low_bits) {
    const std::uint64_t cost = cost_of(code.distances, low_bits);
    if (cost >= code.cost) continue;
    code.cost = cost;
    code.low_bits = low_bits;
  }
  return code;
}

std::int64_t mean_of(std::span<const std::int64_t> values) {
  double sum = 0;
  for (const std::int64_t value : values) sum += static_cast<double>(value);
  return std::llround(sum / static_cast<double>(values.size()));
}

void put_rice(BitWriter& out, std::uint64_t value, int low_bits) {
  const std::uint64_t zeros = value >> low_bits;
  if (zeros >= kEscape) {
    out.put(0, kEscape);
    out.put(value, kWord);
    return;
  }
  out.put(std::uint64_t{1} << zeros, static_cast<int>(zeros) + 1);
  out.put(value, low_bits);
}

}  // namespace

void BitWriter::put(std::uint64_t value, int bits) {
  if (bits < kWord) value &= (std::uint64_t{1} << bits) - 1;
  word_ |= value << filled_;
  if (filled_ + bits < kWord) {
    filled_ += bits;
    return;
  }
  flush(sizeof(word_));
  word_ = filled_ == 0 ? 0 : value >> (kWord - filled_);
  filled_ += bits - kWord;
}

void BitWriter::put(double value) { put(std::bit_cast<std::uint64_t>(value), kWord); }

void BitWriter::put(std::string_view text) {
  put(text.size(), kTextWidth);
  for (const char byte : text) put(static_cast<std::uint8_t>(byte), 8);
}

void BitWriter::flush(int bytes) {
  bytes_.append(reinterpret_cast<const char*>(&word_), static_cast<std::size_t>(bytes));
}

std::string BitWriter::finish() {
  flush((filled_ + 7) / 8);
  word_ = 0;
  filled_ = 0;
  return std::exchange(bytes_, {});
}

BitReader::BitReader(std::string bytes) : bytes_(std::move(bytes)), size_(8 * bytes_.size()) {
  bytes_.append(kPadding, '\0');
}

/// The next 64 bits; zeros behind the end.
std::uint64_t BitReader::window() const {
  std::uint64_t low = 0;
  std::memcpy(&low, bytes_.data() + at_ / 8, sizeof(low));
  const auto high = static_cast<std::uint8_t>(bytes_[at_ / 8 + sizeof(low)]);
  const int shift = static_cast<int>(at_ % 8);
  return low >> shift | std::uint64_t{high} << 1 << (kWord - 1 - shift);
}

void BitReader::advance(std::size_t bits) {
  at_ += bits;
  if (at_ <= size_) return;
  at_ = size_;
  throw Error("its content ends too early");
}

std::uint64_t BitReader::take(int bits) {
  const std::uint64_t value = window();
  advance(static_cast<std::size_t>(bits));
  return bits < kWord ? value & ((std::uint64_t{1} << bits) - 1) : value;
}

double BitReader::take_double() { return std::bit_cast<double>(take(kWord)); }

std::string BitReader::take_text() {
  const std::uint64_t size = take(kTextWidth);
  if (size > bits_left() / 8) throw Error("its content ends too early");
  std::string text;
  for (std::uint64_t i = 0; i < size; ++i) text.push_back(static_cast<char>(take(8)));
  return text;
}

std::uint64_t BitReader::take_rice(int low_bits) {
  const std::uint64_t bits = window();
  const int zeros = std::countr_zero(bits);
  if (zeros >= kEscape) {
    advance(kEscape);
    return take(kWord);
  }
  at_ += static_cast<std::size_t>(zeros) + 1;  // at most 33 bits behind the end: padded
  return static_cast<std::uint64_t>(zeros) << low_bits | take(low_bits);
}

void write_column(BitWriter& out, std::span<const std::int64_t> values) {
  if (values.empty()) return;
  const Code plain = code_of(values, false, *std::min_element(values.begin(), values.end()));
  const Code around = code_of(values, true, mean_of(values));
  const Code& code = plain.cost <= around.cost ? plain : around;
  const std::uint64_t centre = folded(static_cast<std::uint64_t>(code.centre));
  out.put(code.fold ? 1 : 0, 1);
  out.put(static_cast<std::uint64_t>(code.low_bits), kLowBitsWidth);
  const int length = kWord - std::countl_zero(centre);
  out.put(static_cast<std::uint64_t>(length), kLengthWidth);
  out.put(centre, length);
  for (const std::uint64_t distance : code.distances) put_rice(out, distance, code.low_bits);
}

std::vector<std::int64_t> read_column(BitReader& in, std::size_t count) {
  if (count == 0) return {};
  if (count > in.bits_left()) throw Error("its content ends too early");
  const bool fold = in.take(1) != 0;
  const int low_bits = static_cast<int>(in.take(kLowBitsWidth));
  const int length = static_cast<int>(in.take(kLengthWidth));
  if (length > kWord) throw Error("a centre is longer than 64 bits");
  const std::uint64_t centre = unfolded(in.take(length));
  std::vector<std::int64_t> values(count);
  for (std::int64_t& value : values) {
    const std::uint64_t distance = in.take_rice(low_bits);
    value = static_cast<std::int64_t>(centre + (fold ? unfolded(distance) : distance));
  }
  return values;
}

}  // namespace saker::objects
