#pragma once

#include <cstdint>
#include <cstring>

/// Numbers in packets: the host is little-endian, as Ouster's packets are; network order is for IP
/// headers.
namespace saker::lidar {

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__);

template <class T>
[[nodiscard]] T read_little(const std::uint8_t* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

template <class T>
void write_little(T value, std::uint8_t* bytes) {
  std::memcpy(bytes, &value, sizeof value);
}

[[nodiscard]] inline std::uint16_t read_network16(const std::uint8_t* bytes) {
  return static_cast<std::uint16_t>(bytes[0] << 8 | bytes[1]);
}

inline void write_network16(unsigned value, std::uint8_t* bytes) {
  bytes[0] = static_cast<std::uint8_t>(value >> 8 & 0xFF);
  bytes[1] = static_cast<std::uint8_t>(value & 0xFF);
}

}  // namespace saker::lidar
