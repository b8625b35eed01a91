#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace saker::flight {

/// Where datagrams come from and go to.
struct Address {
  std::uint32_t ip = 0;  ///< IPv4, the first number in the upper byte
  std::uint16_t port = 0;

  auto operator<=>(const Address&) const = default;
};

[[nodiscard]] std::string to_string(const Address& address);

/// Of "192.168.8.1:7670". Throws Error that names the setting on anything else.
[[nodiscard]] Address address_of(const std::string& key, const std::string& text);

/// Whether it is this machine's own.
[[nodiscard]] bool is_own(const Address& address);

/// Plain UDP, without waiting.
class UdpSocket {
 public:
  struct Datagram {
    Address from;
    std::string bytes;
  };

  /// On all interfaces. \param port  0: any that is free
  /// Throws Error where the port is taken.
  explicit UdpSocket(std::uint16_t port);
  ~UdpSocket();
  UdpSocket(const UdpSocket&) = delete;
  UdpSocket& operator=(const UdpSocket&) = delete;

  /// False where the kernel does not take it (no route, no room).
  bool send(const Address& to, std::string_view bytes) const;
  /// Nothing where none waits.
  [[nodiscard]] std::optional<Datagram> receive() const;
  /// Which can be read when a datagram waits.
  [[nodiscard]] int descriptor() const { return descriptor_; }

 private:
  int descriptor_ = -1;
};

}  // namespace saker::flight
