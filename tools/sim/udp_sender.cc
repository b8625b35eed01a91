#include "tools/sim/udp_sender.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "saker/core/error.h"

namespace saker::tools {
namespace {

constexpr int kBufferBytes = 1 << 20;  ///< a revolution of 128×1024 in flight

}  // namespace

UdpSender::UdpSender(int port)
    : socket_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)), port_(port) {
  if (socket_ < 0) throw Error(std::string("UDP socket: ") + std::strerror(errno));
  setsockopt(socket_, SOL_SOCKET, SO_SNDBUF, &kBufferBytes, sizeof(kBufferBytes));
}

UdpSender::~UdpSender() { close(socket_); }

void UdpSender::send(std::span<const std::uint8_t> payload) {
  // Not connected: a port that nobody listens to must not fail the next datagram.
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(static_cast<std::uint16_t>(port_));
  to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const ssize_t bytes = sendto(socket_, payload.data(), payload.size(), MSG_DONTWAIT,
                               reinterpret_cast<const sockaddr*>(&to), sizeof(to));
  if (bytes == static_cast<ssize_t>(payload.size())) {
    ++sent_;
  } else {
    ++refused_;
  }
}

}  // namespace saker::tools
