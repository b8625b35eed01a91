#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "saker/lidar/udp_source.h"

namespace saker::lidar {

/// A datagram, where it comes from, and when the kernel had it, however late it is read.
struct UdpDatagram {
  std::span<const std::uint8_t> payload;  ///< valid until the next call
  UdpSource source;
  std::chrono::steady_clock::time_point arrival;
};

/// Receives a sensor's UDP packets on one port. The kernel's buffer holds what arrives while the
/// reader is busy: 4 MB are 130 ms of 1280 packets of 24 kB a second. Unprivileged processes get no
/// more than net.core.rmem_max; see `buffer_bytes`.
///
/// Datagrams of others than the sensor can be left to the kernel (`hear_only`, a socket filter):
/// they cost no buffer, wake nobody and are counted.
class UdpReceiver {
 public:
  static constexpr int kDefaultBufferBytes = 4 << 20;

  /// Port 0: any free one. Throws Error when the port cannot be had.
  explicit UdpReceiver(int port, int buffer_bytes = kDefaultBufferBytes);
  ~UdpReceiver();
  UdpReceiver(const UdpReceiver&) = delete;
  UdpReceiver& operator=(const UdpReceiver&) = delete;

  [[nodiscard]] int port() const { return port_; }
  [[nodiscard]] int descriptor() const { return socket_; }  ///< for poll(2) on several at once
  [[nodiscard]] int buffer_bytes() const;                   ///< that the kernel granted

  /// Takes datagrams of the network interface alone by which this machine reaches the address.
  /// Throws Error where none does.
  void bind_to_interface_of(std::uint32_t address);

  /// From now on the kernel drops what comes from elsewhere; port 0: from any port of the address.
  /// Address 0: everybody is heard again. Does nothing where it is so already. False where the
  /// kernel refuses.
  bool hear_only(const UdpSource& source);

  /// What the kernel dropped so far: of others, and what found the buffer full.
  [[nodiscard]] long kernel_drops() const;

  /// The next datagram, or nothing after the timeout (0: at once). Valid until the next call.
  [[nodiscard]] std::span<const std::uint8_t> receive(std::chrono::milliseconds timeout);

  /// The next one if it is here: one system call.
  [[nodiscard]] std::optional<UdpDatagram> take();

 private:
  int socket_ = -1;
  int port_ = 0;
  UdpSource only_;
  std::vector<std::uint8_t> buffer_;
};

}  // namespace saker::lidar
