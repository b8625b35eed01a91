#include "saker/lidar/udp_receiver.h"

#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string>

#include "saker/core/error.h"

namespace saker::lidar {
namespace {

constexpr std::size_t kLargestDatagram = 65535;

int bind_to(int socket, int port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_ANY);
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  if (::bind(socket, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) return -1;
  socklen_t size = sizeof address;
  if (::getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size) != 0) return -1;
  return ntohs(address.sin_port);
}

/// Beyond the system's limit where that is allowed, else up to it.
void request_buffer(int socket, int bytes) {
  if (::setsockopt(socket, SOL_SOCKET, SO_RCVBUFFORCE, &bytes, sizeof bytes) == 0) return;
  ::setsockopt(socket, SOL_SOCKET, SO_RCVBUF, &bytes, sizeof bytes);
}

}  // namespace

UdpReceiver::UdpReceiver(int port, int buffer_bytes) : buffer_(kLargestDatagram) {
  if (port < 0 || port > 65535) {
    throw Error("UDP port " + std::to_string(port) + ", expected 0 to 65535");
  }
  socket_ = ::socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (socket_ >= 0) {
    request_buffer(socket_, buffer_bytes);
    port_ = bind_to(socket_, port);
  }
  if (socket_ >= 0 && port_ >= 0) return;
  const std::string why = std::strerror(errno);
  if (socket_ >= 0) ::close(socket_);
  throw Error("cannot receive on UDP port " + std::to_string(port) + ": " + why);
}

UdpReceiver::~UdpReceiver() { ::close(socket_); }

int UdpReceiver::buffer_bytes() const {
  int granted = 0;
  socklen_t size = sizeof granted;
  ::getsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &granted, &size);
  return granted / 2;  // the kernel counts its own share too
}

std::span<const std::uint8_t> UdpReceiver::receive(std::chrono::milliseconds timeout) {
  pollfd ready{socket_, POLLIN, 0};
  if (::poll(&ready, 1, static_cast<int>(std::max<std::int64_t>(0, timeout.count()))) <= 0) {
    return {};
  }
  const ssize_t size = ::recv(socket_, buffer_.data(), buffer_.size(), 0);
  if (size <= 0) return {};
  return {buffer_.data(), static_cast<std::size_t>(size)};
}

}  // namespace saker::lidar
