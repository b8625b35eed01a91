#include "flight/mavlink/line.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <optional>
#include <utility>

#include "saker/core/error.h"

namespace saker::flight::mavlink {
namespace {

constexpr std::array<std::pair<int, speed_t>, 8> kBauds = {{{57600, B57600},
                                                            {115200, B115200},
                                                            {230400, B230400},
                                                            {460800, B460800},
                                                            {500000, B500000},
                                                            {921600, B921600},
                                                            {1000000, B1000000},
                                                            {2000000, B2000000}}};

std::optional<speed_t> speed_of(int baud) {
  for (const auto& [number, speed] : kBauds)
    if (number == baud) return speed;
  return std::nullopt;
}

std::optional<int> number_of(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<sockaddr_in> socket_address(const std::string& host, int port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  if (::inet_pton(AF_INET, host.c_str(), &address.sin_addr) != 1) return std::nullopt;
  return address;
}

const sockaddr* generic(const sockaddr_in& address) {
  return reinterpret_cast<const sockaddr*>(&address);
}

bool later(int error) {
  return error == EAGAIN || error == EWOULDBLOCK || error == EINTR || error == EINPROGRESS ||
         error == ENOTCONN;
}

}  // namespace

Address parsed_address(const std::string& text) {
  const Error wrong("mavlink.line: " + text +
                    ", expected serial:DEVICE:BAUD, udp:IP:PORT, udp:listen:PORT or tcp:IP:PORT");
  const std::size_t first = text.find(':'), last = text.rfind(':');
  if (first == std::string::npos || first == last) throw wrong;
  const std::string kind = text.substr(0, first);
  Address address;
  address.place = text.substr(first + 1, last - first - 1);
  const auto number = number_of(std::string_view(text).substr(last + 1));
  if (!number || address.place.empty()) throw wrong;
  address.number = *number;
  if (kind == "serial" && speed_of(address.number)) {
    address.kind = Address::Kind::serial;
    return address;
  }
  if ((kind != "udp" && kind != "tcp") || address.number < 1 || address.number > 65535) throw wrong;
  if (kind == "udp" && address.place == "listen") {
    address.place = "0.0.0.0";
    address.kind = Address::Kind::udp_listen;
    return address;
  }
  address.kind = kind == "udp" ? Address::Kind::udp : Address::Kind::tcp;
  if (!socket_address(address.place, address.number)) throw wrong;
  return address;
}

void Line::step(Time now) {
  const bool silent =
      address_.kind == Address::Kind::udp_listen && has_peer_ && now - heard_at_ > kSilence;
  if (silent) broke("its sender is silent");
  if (!is_open() && now >= next_open_) {
    next_open_ = now + kRetry;
    open();
  }
  flush();
}

void Line::open() {
  queued_ = 0;
  has_peer_ = address_.kind != Address::Kind::udp_listen;
  if (address_.kind == Address::Kind::serial)
    open_serial();
  else
    open_socket();
  counters_.opened += is_open();
}

void Line::open_serial() {
  descriptor_ = ::open(address_.place.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor_ < 0) return broke("cannot be opened", errno);
  // Two readers of one port would share its bytes.
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) return broke("another program has it", errno);
  termios settings{};
  if (::tcgetattr(descriptor_, &settings) != 0) return broke("is no serial port", errno);
  ::cfmakeraw(&settings);
  settings.c_cflag |= CLOCAL | CREAD;
  settings.c_cflag &= ~static_cast<tcflag_t>(CRTSCTS);
  ::cfsetspeed(&settings, *speed_of(address_.number));
  if (::tcsetattr(descriptor_, TCSANOW, &settings) != 0)
    return broke("does not take the baud rate", errno);
  ::tcflush(descriptor_, TCIOFLUSH);
}

void Line::open_socket() {
  const bool tcp = address_.kind == Address::Kind::tcp;
  const auto address = socket_address(address_.place, address_.number);
  descriptor_ =
      ::socket(AF_INET, (tcp ? SOCK_STREAM : SOCK_DGRAM) | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (descriptor_ < 0 || !address) return broke("has no socket", errno);
  const int on = 1;
  if (tcp) ::setsockopt(descriptor_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  if (address_.kind == Address::Kind::udp_listen) {
    if (::bind(descriptor_, generic(*address), sizeof *address) != 0)
      broke("the port is in use", errno);
    return;
  }
  if (::connect(descriptor_, generic(*address), sizeof *address) != 0 && !later(errno))
    broke("cannot be reached", errno);
}

void Line::close() {
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = -1;
  has_peer_ = false;
  queued_ = 0;
}

void Line::broke(const char* what, int error) {
  fault_ = fmt::format("{}:{} {}", address_.place, address_.number, what);
  if (error != 0) fault_ += fmt::format(" ({})", std::strerror(error));
  counters_.lost += is_open();
  close();
}

/// Who sends first on a port that listens is the autopilot: others are not heard from then on.
std::span<const std::uint8_t> Line::read(std::span<std::uint8_t> buffer, Time now) {
  if (!is_open()) return {};
  sockaddr_in from{};
  socklen_t length = sizeof from;
  const bool first = !has_peer_;
  const ssize_t count = first ? ::recvfrom(descriptor_, buffer.data(), buffer.size(), 0,
                                           reinterpret_cast<sockaddr*>(&from), &length)
                              : ::read(descriptor_, buffer.data(), buffer.size());
  if (count < 0) {
    // A UDP port that nobody listens on refuses; somebody may, later.
    if (!later(errno) && !(in_datagrams() && errno == ECONNREFUSED)) broke("is gone", errno);
    return {};
  }
  if (count == 0) {
    if (!in_datagrams()) broke("was closed by the other end");
    return {};
  }
  if (first) has_peer_ = ::connect(descriptor_, generic(from), length) == 0;
  heard_at_ = now;
  counters_.received += count;
  return buffer.first(static_cast<std::size_t>(count));
}

void Line::write(std::span<const std::uint8_t> frame) {
  if (!is_open() || !has_peer_) return;
  if (in_datagrams()) {
    const ssize_t count = ::send(descriptor_, frame.data(), frame.size(), MSG_NOSIGNAL);
    counters_.sent += std::max<ssize_t>(count, 0);
    counters_.dropped += count < 0;
    return;
  }
  if (queued_ + frame.size() > queue_.size()) {
    ++counters_.dropped;
    return;
  }
  std::copy(frame.begin(), frame.end(), queue_.begin() + queued_);
  queued_ += frame.size();
  flush();
}

void Line::flush() {
  if (!is_open() || queued_ == 0) return;
  const ssize_t count = address_.kind == Address::Kind::tcp
                            ? ::send(descriptor_, queue_.data(), queued_, MSG_NOSIGNAL)
                            : ::write(descriptor_, queue_.data(), queued_);
  if (count < 0) {
    if (!later(errno)) broke("is gone", errno);
    return;
  }
  std::memmove(queue_.data(), queue_.data() + count, queued_ - static_cast<std::size_t>(count));
  queued_ -= static_cast<std::size_t>(count);
  counters_.sent += count;
}

}  // namespace saker::flight::mavlink
