#pragma once

#include <cstdint>
#include <span>

namespace saker::tools {

/// Sends UDP datagrams to one port of this machine, as a sensor on its network would. Never blocks:
/// what the kernel does not take is counted.
class UdpSender {
 public:
  /// Throws Error when there is no socket to be had.
  explicit UdpSender(int port);
  ~UdpSender();
  UdpSender(const UdpSender&) = delete;
  UdpSender& operator=(const UdpSender&) = delete;

  void send(std::span<const std::uint8_t> payload);

  [[nodiscard]] long sent() const { return sent_; }
  [[nodiscard]] long refused() const { return refused_; }

 private:
  int socket_ = -1;
  int port_;
  long sent_ = 0;
  long refused_ = 0;
};

}  // namespace saker::tools
