#include "flight/link/udp_socket.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <ifaddrs.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>

#include "saker/core/error.h"

namespace saker::flight {
namespace {

constexpr std::size_t kLongest = 2048;      // a link's datagram has 1400 bytes at most
constexpr int kReceiveBuffer = 512 * 1024;  // a second of all that a link may send

sockaddr_in socket_address(const Address& address) {
  sockaddr_in result{};
  result.sin_family = AF_INET;
  result.sin_addr.s_addr = htonl(address.ip);
  result.sin_port = htons(address.port);
  return result;
}

}  // namespace

std::string to_string(const Address& address) {
  return fmt::format("{}.{}.{}.{}:{}", address.ip >> 24, address.ip >> 16 & 255,
                     address.ip >> 8 & 255, address.ip & 255, address.port);
}

Address address_of(const std::string& key, const std::string& text) {
  const std::size_t colon = text.find(':');
  const std::string host = text.substr(0, colon);
  in_addr ip{};
  std::uint16_t port = 0;
  if (colon != std::string::npos && ::inet_pton(AF_INET, host.c_str(), &ip) == 1) {
    const char* const end = text.data() + text.size();
    const auto [stop, fault] = std::from_chars(text.data() + colon + 1, end, port);
    if (fault == std::errc{} && stop == end && port > 0) return {ntohl(ip.s_addr), port};
  }
  throw Error(fmt::format("{} {}, expected ADDRESS:PORT as in 192.168.8.1:7670", key, text));
}

bool is_own(const Address& address) {
  if (address.ip == INADDR_ANY || address.ip >> 24 == IN_LOOPBACKNET) return true;
  ifaddrs* first = nullptr;
  if (::getifaddrs(&first) != 0) return false;
  bool own = false;
  for (const ifaddrs* one = first; one != nullptr && !own; one = one->ifa_next) {
    if (one->ifa_addr == nullptr || one->ifa_addr->sa_family != AF_INET) continue;
    sockaddr_in ip{};
    std::memcpy(&ip, one->ifa_addr, sizeof ip);
    own = ntohl(ip.sin_addr.s_addr) == address.ip;
  }
  ::freeifaddrs(first);
  return own;
}

UdpSocket::UdpSocket(std::uint16_t port)
    : descriptor_(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)) {
  (void)::setsockopt(descriptor_, SOL_SOCKET, SO_RCVBUF, &kReceiveBuffer, sizeof kReceiveBuffer);
  const sockaddr_in any = socket_address({INADDR_ANY, port});
  if (::bind(descriptor_, reinterpret_cast<const sockaddr*>(&any), sizeof any) == 0) return;
  const std::string fault = std::strerror(errno);
  ::close(descriptor_);
  throw Error(fmt::format("UDP port {}: {}", port, fault));
}

UdpSocket::~UdpSocket() { ::close(descriptor_); }

bool UdpSocket::send(const Address& to, std::string_view bytes) const {
  const sockaddr_in address = socket_address(to);
  return ::sendto(descriptor_, bytes.data(), bytes.size(), 0,
                  reinterpret_cast<const sockaddr*>(&address),
                  sizeof address) == static_cast<ssize_t>(bytes.size());
}

std::optional<UdpSocket::Datagram> UdpSocket::receive() const {
  std::array<char, kLongest> buffer;
  sockaddr_in from{};
  socklen_t size = sizeof from;
  const ssize_t length = ::recvfrom(descriptor_, buffer.data(), buffer.size(), 0,
                                    reinterpret_cast<sockaddr*>(&from), &size);
  if (length < 0) return std::nullopt;
  return Datagram{{ntohl(from.sin_addr.s_addr), ntohs(from.sin_port)},
                  std::string(buffer.data(), static_cast<std::size_t>(length))};
}

}  // namespace saker::flight
