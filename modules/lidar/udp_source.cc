#include "saker/lidar/udp_source.h"

#include <arpa/inet.h>

namespace saker::lidar {

std::string to_string(const UdpSource& source) {
  std::string text;
  for (int shift = 24; shift >= 0; shift -= 8) {
    text += std::to_string(source.address >> shift & 0xFF) + (shift > 0 ? "." : ":");
  }
  return text + std::to_string(source.port);
}

std::optional<std::uint32_t> parse_address(const std::string& dotted) {
  in_addr address{};
  if (::inet_pton(AF_INET, dotted.c_str(), &address) != 1) return std::nullopt;
  return ntohl(address.s_addr);
}

}  // namespace saker::lidar
