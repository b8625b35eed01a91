#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

/// MD5 (RFC 1321), only to compare with the digests that the vendor publishes.
namespace saker::lidar::testing {

inline void md5_block(const std::uint8_t* block, std::array<std::uint32_t, 4>& state) {
  constexpr int kTurns[4][4] = {{7, 12, 17, 22}, {5, 9, 14, 20}, {4, 11, 16, 23}, {6, 10, 15, 21}};
  std::array<std::uint32_t, 16> words;
  std::memcpy(words.data(), block, 64);
  auto [a, b, c, d] = state;
  for (int i = 0; i < 64; ++i) {
    const int round = i / 16;
    const std::uint32_t mixed = round == 0   ? (b & c) | (~b & d)
                                : round == 1 ? (d & b) | (~d & c)
                                : round == 2 ? b ^ c ^ d
                                             : c ^ (b | ~d);
    const int word = (round == 0   ? i
                      : round == 1 ? 5 * i + 1
                      : round == 2 ? 3 * i + 5
                                   : 7 * i) %
                     16;
    const auto sine =
        static_cast<std::uint32_t>(std::floor(std::abs(std::sin(i + 1)) * 4294967296.0));
    const std::uint32_t next = b + std::rotl(a + mixed + sine + words[word], kTurns[round][i % 4]);
    a = d;
    d = c;
    c = b;
    b = next;
  }
  state = {state[0] + a, state[1] + b, state[2] + c, state[3] + d};
}

inline std::string md5(const void* data, std::size_t size) {
  std::vector<std::uint8_t> bytes(size);
  std::memcpy(bytes.data(), data, size);
  const std::uint64_t bits = size * 8;
  bytes.push_back(0x80);
  while (bytes.size() % 64 != 56) bytes.push_back(0);
  bytes.resize(bytes.size() + 8);
  std::memcpy(bytes.data() + bytes.size() - 8, &bits, 8);
  std::array<std::uint32_t, 4> state = {0x67452301, 0xEFCDAB89, 0x98BADCFE, 0x10325476};
  for (std::size_t at = 0; at < bytes.size(); at += 64) md5_block(&bytes[at], state);
  std::string text;
  for (const std::uint32_t word : state) {
    for (int i = 0; i < 4; ++i) {
      char digits[3];
      std::snprintf(digits, sizeof digits, "%02x", word >> 8 * i & 0xFF);
      text += digits;
    }
  }
  return text;
}

}  // namespace saker::lidar::testing
