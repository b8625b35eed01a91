#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Columns of whole numbers in few bits: Rice's code (Golomb, "Run-length encodings", 1966; Rice,
/// "Some Practical Universal Noiseless Coding Techniques", 1979), which is within 0.03 to 0.13
/// bits of the entropy of geometrically distributed numbers, as gaps between sorted random places
/// are.
namespace saker::objects {

/// Bits into bytes, the lowest bit first.
class BitWriter {
 public:
  void put(std::uint64_t value, int bits);  ///< its lowest bits, 0 … 64 of them
  void put(double value);
  void put(std::string_view text);  ///< length and bytes
  [[nodiscard]] std::string finish();

 private:
  void flush(int bytes);

  std::string bytes_;
  std::uint64_t word_ = 0;
  int filled_ = 0;
};

/// Reads what BitWriter wrote; throws Error where the bytes end too early.
class BitReader {
 public:
  explicit BitReader(std::string bytes);

  [[nodiscard]] std::uint64_t take(int bits);
  [[nodiscard]] double take_double();
  [[nodiscard]] std::string take_text();
  /// A number in Rice's code with `low_bits` bits as they are.
  [[nodiscard]] std::uint64_t take_rice(int low_bits);

  [[nodiscard]] std::size_t bits_left() const { return size_ - at_; }

 private:
  [[nodiscard]] std::uint64_t window() const;
  void advance(std::size_t bits);

  std::string bytes_;
  std::size_t at_ = 0, size_ = 0;  ///< bits
};

/// As distances from the least number or, folded, from the mean: whichever is shorter.
void write_column(BitWriter& out, std::span<const std::int64_t> values);

/// Allocates no more than a number for each bit that is left; throws Error where they end.
[[nodiscard]] std::vector<std::int64_t> read_column(BitReader& in, std::size_t count);

}  // namespace saker::objects
