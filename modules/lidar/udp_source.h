#pragma once

#include <cstdint>
#include <optional>
#include <string>

/// Where a UDP datagram comes from.
namespace saker::lidar {

/// Address and port in the machine's byte order; 0: unknown, or any.
struct UdpSource {
  std::uint32_t address = 0;  ///< IPv4, 127.0.0.1 is 0x7F000001
  std::uint16_t port = 0;

  bool operator==(const UdpSource&) const = default;
};

/// "192.168.7.2:7502".
[[nodiscard]] std::string to_string(const UdpSource& source);

/// Of a dotted address; nothing where it is none.
[[nodiscard]] std::optional<std::uint32_t> parse_address(const std::string& dotted);

}  // namespace saker::lidar
