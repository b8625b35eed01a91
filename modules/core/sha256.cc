#include "saker/core/sha256.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace saker::core {
namespace {

using State = std::array<std::uint32_t, 8>;
using Block = std::array<std::uint8_t, 64>;

bool is_prime(std::uint32_t n) {
  for (std::uint32_t d = 2; d * d <= n; ++d) {
    if (n % d == 0) return false;
  }
  return true;
}

/// First 32 bits of the fraction of a root of n.
std::uint32_t fraction_bits(long double root) {
  return static_cast<std::uint32_t>((root - std::floor(root)) * 4294967296.0L);
}

struct Constants {
  std::array<std::uint32_t, 64> round;  // of the cube roots of the first 64 primes
  State start;                          // of the square roots of the first 8

  Constants() {
    std::size_t found = 0;
    for (std::uint32_t n = 2; found < round.size(); ++n) {
      if (!is_prime(n)) continue;
      round[found] = fraction_bits(std::cbrt(static_cast<long double>(n)));
      if (found < start.size())
        start[found] = fraction_bits(std::sqrt(static_cast<long double>(n)));
      ++found;
    }
  }
};

const Constants& constants() {
  static const Constants values;
  return values;
}

std::array<std::uint32_t, 64> schedule(const Block& block) {
  std::array<std::uint32_t, 64> w{};
  for (std::size_t i = 0; i < 16; ++i) {
    w[i] = std::uint32_t{block[4 * i]} << 24 | std::uint32_t{block[4 * i + 1]} << 16 |
           std::uint32_t{block[4 * i + 2]} << 8 | std::uint32_t{block[4 * i + 3]};
  }
  for (std::size_t i = 16; i < 64; ++i) {
    const std::uint32_t a = w[i - 15], b = w[i - 2];
    w[i] = w[i - 16] + (std::rotr(a, 7) ^ std::rotr(a, 18) ^ (a >> 3)) + w[i - 7] +
           (std::rotr(b, 17) ^ std::rotr(b, 19) ^ (b >> 10));
  }
  return w;
}

void digest(State& state, const Block& block) {
  const auto w = schedule(block);
  auto [a, b, c, d, e, f, g, h] = state;
  for (std::size_t i = 0; i < 64; ++i) {
    const std::uint32_t s1 = std::rotr(e, 6) ^ std::rotr(e, 11) ^ std::rotr(e, 25);
    const std::uint32_t t1 = h + s1 + ((e & f) ^ (~e & g)) + constants().round[i] + w[i];
    const std::uint32_t s0 = std::rotr(a, 2) ^ std::rotr(a, 13) ^ std::rotr(a, 22);
    const std::uint32_t t2 = s0 + ((a & b) ^ (a & c) ^ (b & c));
    h = g, g = f, f = e, e = d + t1, d = c, c = b, b = a, a = t1 + t2;
  }
  const State change = {a, b, c, d, e, f, g, h};
  for (std::size_t i = 0; i < state.size(); ++i) state[i] += change[i];
}

/// The end of the message: its last bytes, a one, zeros, its length in bits.
std::string tail_of(std::string_view bytes) {
  std::string tail(bytes.substr(bytes.size() / 64 * 64));
  tail.push_back(static_cast<char>(0x80));
  while (tail.size() % 64 != 56) tail.push_back(0);
  const std::uint64_t bits = std::uint64_t{bytes.size()} * 8;
  for (int shift = 56; shift >= 0; shift -= 8)
    tail.push_back(static_cast<char>(bits >> shift & 0xFF));
  return tail;
}

void digest_blocks(State& state, std::string_view bytes) {
  for (std::size_t begin = 0; begin + 64 <= bytes.size(); begin += 64) {
    Block block{};
    for (std::size_t i = 0; i < 64; ++i) block[i] = static_cast<std::uint8_t>(bytes[begin + i]);
    digest(state, block);
  }
}

}  // namespace

std::string sha256(std::string_view bytes) {
  State state = constants().start;
  digest_blocks(state, bytes);
  digest_blocks(state, tail_of(bytes));
  constexpr const char* kDigits = "0123456789abcdef";
  std::string hex;
  for (const std::uint32_t word : state) {
    for (int shift = 28; shift >= 0; shift -= 4) hex.push_back(kDigits[word >> shift & 0xF]);
  }
  return hex;
}

}  // namespace saker::core
