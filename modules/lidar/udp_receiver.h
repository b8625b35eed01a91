#pragma once

#include <chrono>
#include <cstdint>
#include <span>
#include <vector>

namespace saker::lidar {

/// Receives a sensor's UDP packets on one port. The kernel's buffer holds what arrives while the
/// reader is busy: 4 MB are 130 ms of 1280 packets of 24 kB a second. Unprivileged processes get no
/// more than net.core.rmem_max; see `buffer_bytes`.
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

  /// The next datagram, or nothing after the timeout (0: at once). Valid until the next call.
  [[nodiscard]] std::span<const std::uint8_t> receive(std::chrono::milliseconds timeout);

 private:
  int socket_ = -1;
  int port_ = 0;
  std::vector<std::uint8_t> buffer_;
};

}  // namespace saker::lidar
