#include "saker/lidar/udp_source.h"

#include <charconv>

namespace saker::lidar {

std::string to_string(const UdpSource& source) {
  std::string text;
  for (int shift = 24; shift >= 0; shift -= 8) {
    text += std::to_string(source.address >> shift & 0xFF) + (shift > 0 ? "." : ":");
  }
  return text + std::to_string(source.port);
}

std::optional<std::uint32_t> parse_address(const std::string& dotted) {
  const char* at = dotted.data();
  const char* const end = at + dotted.size();
  std::uint32_t address = 0;
  for (int part = 0; part < 4; ++part) {
    if (part > 0 && (at == end || *at++ != '.')) return std::nullopt;
    unsigned value = 0;
    const auto [rest, error] = std::from_chars(at, end, value);
    if (error != std::errc() || value > 255) return std::nullopt;
    at = rest;
    address = address << 8 | value;
  }
  return at == end ? std::optional(address) : std::nullopt;
}

}  // namespace saker::lidar
