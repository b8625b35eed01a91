#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <vector>

#include "saker/lidar/cursor.h"

/// Messages of LCM ↔ bytes, for targets and seeds.
namespace saker::lidar::fuzz {

constexpr std::size_t kFingerprintBytes = 8;

/// `body` behind the type's fingerprint, so that all of the input is read; nothing where it is no
/// message.
template <class Message>
[[nodiscard]] std::optional<Message> decoded(ByteView body) {
  const auto fingerprint = std::bit_cast<std::array<std::uint8_t, kFingerprintBytes>>(
      static_cast<std::int64_t>(Message::getHash()));
  std::vector<std::uint8_t> bytes(fingerprint.rbegin(), fingerprint.rend());  // big-endian
  bytes.insert(bytes.end(), body.begin(), body.end());
  Message message{};
  if (message.decode(bytes.data(), 0, static_cast<int>(bytes.size())) < 0) return std::nullopt;
  return message;
}

/// Without the fingerprint.
template <class Message>
[[nodiscard]] std::vector<std::uint8_t> body_of(const Message& message) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  bytes.erase(bytes.begin(), bytes.begin() + kFingerprintBytes);
  return bytes;
}

}  // namespace saker::lidar::fuzz
