#include "saker/lidar/udp_receiver.h"

#include <ifaddrs.h>
#include <linux/filter.h>
#include <linux/sock_diag.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <ctime>
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

/// Address of this machine that packets to another one leave from; 0: there is no way.
std::uint32_t local_address_towards(std::uint32_t address) {
  const int probe = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (probe < 0) return 0;
  sockaddr_in there{};
  there.sin_family = AF_INET;
  there.sin_port = htons(9);  // nothing is sent
  there.sin_addr.s_addr = htonl(address);
  sockaddr_in here{};
  socklen_t size = sizeof here;
  const bool found = ::connect(probe, reinterpret_cast<sockaddr*>(&there), sizeof there) == 0 &&
                     ::getsockname(probe, reinterpret_cast<sockaddr*>(&here), &size) == 0;
  ::close(probe);
  return found ? ntohl(here.sin_addr.s_addr) : 0;
}

/// Name of the interface that has the address; empty where none has.
std::string interface_with(std::uint32_t address) {
  ifaddrs* all = nullptr;
  if (::getifaddrs(&all) != 0) return "";
  std::string name;
  for (const ifaddrs* one = all; one != nullptr && name.empty(); one = one->ifa_next) {
    if (one->ifa_addr == nullptr || one->ifa_addr->sa_family != AF_INET) continue;
    const auto* at = reinterpret_cast<const sockaddr_in*>(one->ifa_addr);
    if (ntohl(at->sin_addr.s_addr) == address) name = one->ifa_name;
  }
  ::freeifaddrs(all);
  return name;
}

/// When the kernel had it: its stamp is of the system's clock, which may be set. What would lie
/// ahead came now, and nothing lies longer than a minute.
std::chrono::steady_clock::time_point arrival_of(msghdr& message) {
  const auto now = std::chrono::steady_clock::now();
  for (cmsghdr* part = CMSG_FIRSTHDR(&message); part; part = CMSG_NXTHDR(&message, part)) {
    if (part->cmsg_level != SOL_SOCKET || part->cmsg_type != SO_TIMESTAMPNS) continue;
    timespec stamp{}, system{};
    std::memcpy(&stamp, CMSG_DATA(part), sizeof stamp);
    ::clock_gettime(CLOCK_REALTIME, &system);
    const std::chrono::nanoseconds lay = std::chrono::seconds(system.tv_sec - stamp.tv_sec) +
                                         std::chrono::nanoseconds(system.tv_nsec - stamp.tv_nsec);
    return now - std::clamp<std::chrono::nanoseconds>(lay, std::chrono::nanoseconds(0),
                                                      std::chrono::minutes(1));
  }
  return now;
}

sock_filter load(std::uint32_t at) { return {BPF_LD | BPF_W | BPF_ABS, 0, 0, at}; }

}  // namespace

UdpReceiver::UdpReceiver(int port, int buffer_bytes) : buffer_(kLargestDatagram) {
  if (port < 0 || port > 65535) {
    throw Error("UDP port " + std::to_string(port) + ", expected 0 to 65535");
  }
  socket_ = ::socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (socket_ >= 0) {
    request_buffer(socket_, buffer_bytes);
    const int on = 1;
    ::setsockopt(socket_, SOL_SOCKET, SO_TIMESTAMPNS, &on, sizeof on);
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

void UdpReceiver::bind_to_interface_of(std::uint32_t address) {
  const std::string name = interface_with(local_address_towards(address));
  if (!name.empty() && ::setsockopt(socket_, SOL_SOCKET, SO_BINDTODEVICE, name.c_str(),
                                    static_cast<socklen_t>(name.size() + 1)) == 0) {
    return;
  }
  const std::string why =
      name.empty() ? "no interface reaches it" : name + ": " + std::strerror(errno);
  const std::string dotted = to_string(UdpSource{address, 0});
  throw Error("sensor.address: " + dotted.substr(0, dotted.find(':')) + ": " + why);
}

bool UdpReceiver::hear_only(const UdpSource& source) {
  if (source == only_) return true;
  const int none = 0;
  if (source.address == 0) {
    if (::setsockopt(socket_, SOL_SOCKET, SO_DETACH_FILTER, &none, sizeof none) != 0) return false;
    only_ = {};
    return true;
  }
  constexpr std::uint32_t kSourceAddress = 12;  // in the IP header; the port begins the UDP header
  const auto header = static_cast<std::uint32_t>(SKF_NET_OFF);
  std::array<sock_filter, 6> program = {
      load(header + kSourceAddress),
      sock_filter{BPF_JMP | BPF_JEQ | BPF_K, 0, 3, source.address},
      sock_filter{BPF_LD | BPF_H | BPF_ABS, 0, 0, 0},
      sock_filter{BPF_JMP | BPF_JEQ | BPF_K, 0, 1, source.port},
      sock_filter{BPF_RET | BPF_K, 0, 0, 0xFFFFFFFF},
      sock_filter{BPF_RET | BPF_K, 0, 0, 0}};
  if (source.port == 0) program[3].jf = 0;  // any
  const sock_fprog filter{static_cast<unsigned short>(program.size()), program.data()};
  if (::setsockopt(socket_, SOL_SOCKET, SO_ATTACH_FILTER, &filter, sizeof filter) != 0)
    return false;
  only_ = source;
  return true;
}

long UdpReceiver::kernel_drops() const {
  std::array<std::uint32_t, SK_MEMINFO_VARS> figures{};
  socklen_t size = sizeof figures;
  if (::getsockopt(socket_, SOL_SOCKET, SO_MEMINFO, figures.data(), &size) != 0) return 0;
  return figures[SK_MEMINFO_DROPS];
}

std::optional<UdpDatagram> UdpReceiver::take() {
  sockaddr_in from{};
  iovec bytes{buffer_.data(), buffer_.size()};
  alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(timespec))> control;
  msghdr message{};
  message.msg_name = &from;
  message.msg_namelen = sizeof from;
  message.msg_iov = &bytes;
  message.msg_iovlen = 1;
  message.msg_control = control.data();
  message.msg_controllen = control.size();
  const ssize_t size = ::recvmsg(socket_, &message, MSG_DONTWAIT);
  if (size < 0) return std::nullopt;
  return UdpDatagram{{buffer_.data(), static_cast<std::size_t>(size)},
                     {ntohl(from.sin_addr.s_addr), ntohs(from.sin_port)},
                     arrival_of(message)};
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
