#include "flight/bus/multicast.h"

#include <arpa/inet.h>
#include <linux/filter.h>
#include <linux/if_packet.h>
#include <net/if.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <regex>

#include "saker/core/error.h"

namespace saker::flight {
namespace {

constexpr int kReturnTimeoutMs = 200;  // on one machine a datagram is back within 1 ms

/// A UDP socket that closes itself.
class Socket {
 public:
  Socket() : descriptor_(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {}
  ~Socket() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;

  [[nodiscard]] int get() const { return descriptor_; }
  template <class T>
  [[nodiscard]] bool set(int level, int option, const T& value) const {
    return ::setsockopt(descriptor_, level, option, &value, sizeof value) == 0;
  }

 private:
  int descriptor_;
};

sockaddr_in socket_address(in_addr address, std::uint16_t port) {
  sockaddr_in result{};
  result.sin_family = AF_INET;
  result.sin_addr = address;
  result.sin_port = htons(port);
  return result;
}

std::string because(const char* what) { return std::string(what) + ": " + std::strerror(errno); }

/// Binds to any free port and joins; the port, or 0.
std::uint16_t join(const Socket& socket, in_addr group) {
  sockaddr_in any = socket_address({htonl(INADDR_ANY)}, 0);
  socklen_t size = sizeof any;
  const ip_mreq membership{group, {htonl(INADDR_ANY)}};
  const bool joined = ::bind(socket.get(), reinterpret_cast<sockaddr*>(&any), sizeof any) == 0 &&
                      ::getsockname(socket.get(), reinterpret_cast<sockaddr*>(&any), &size) == 0 &&
                      socket.set(IPPROTO_IP, IP_ADD_MEMBERSHIP, membership);
  return joined ? ntohs(any.sin_port) : 0;
}

/// Whether it is a UDP socket that is bound to the port.
bool is_bound_to(int descriptor, std::uint16_t port) {
  int type = 0;
  sockaddr_in bound{};
  socklen_t type_size = sizeof type, size = sizeof bound;
  return ::getsockopt(descriptor, SOL_SOCKET, SO_TYPE, &type, &type_size) == 0 &&
         type == SOCK_DGRAM &&
         ::getsockname(descriptor, reinterpret_cast<sockaddr*>(&bound), &size) == 0 &&
         bound.sin_family == AF_INET && ntohs(bound.sin_port) == port;
}

}  // namespace

MulticastGroup multicast_group(const std::string& url) {
  static const std::regex kForm(R"(udpm://([0-9.]+):([0-9]{1,5})(\?.*)?)");
  std::smatch found;
  in_addr address{};
  const bool formed = std::regex_match(url, found, kForm);
  if (formed && ::inet_pton(AF_INET, found[1].str().c_str(), &address) == 1 &&
      IN_MULTICAST(ntohl(address.s_addr))) {
    const int port = std::stoi(found[2].str());
    if (port > 0 && port <= 65535) return {found[1].str(), static_cast<std::uint16_t>(port)};
  }
  throw Error("LCM URL " + url + ", expected udpm://239.255.76.67:7667?ttl=0 or another group");
}

bool stays_on_machine(const std::string& url) {
  static const std::regex kTtl("[?&]ttl=([^&]*)");
  static const std::regex kNone("0+");
  for (std::sregex_iterator at(url.begin(), url.end(), kTtl), end; at != end; ++at) {
    if (!std::regex_match((*at)[1].str(), kNone)) return false;
  }
  return true;
}

void require_on_machine(const std::string& key, const std::string& url) {
  if (stays_on_machine(url)) return;
  throw Error(key + " " + url +
              ", expected ttl=0: whoever hears the flight bus may send setpoints; saker-link joins "
              "robot and ground (link.ground)");
}

void hear_this_machine_alone(std::uint16_t port) {
  const auto load = [](std::uint16_t size, int what) {
    return sock_filter BPF_STMT(static_cast<std::uint16_t>(BPF_LD | size | BPF_ABS),
                                static_cast<std::uint32_t>(SKF_AD_OFF + what));
  };
  const auto is = [](std::uint32_t value, std::uint8_t skip) {
    return sock_filter BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, value, skip, 0);
  };
  std::array<sock_filter, 6> code = {load(BPF_B, SKF_AD_PKTTYPE),
                                     is(PACKET_LOOPBACK, 3),
                                     load(BPF_W, SKF_AD_IFINDEX),
                                     is(::if_nametoindex("lo"), 1),
                                     sock_filter BPF_STMT(BPF_RET | BPF_K, 0),
                                     sock_filter BPF_STMT(BPF_RET | BPF_K, 0xFFFFFFFF)};
  const sock_fprog filter{static_cast<unsigned short>(code.size()), code.data()};
  int sockets = 0;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
    const int descriptor = std::stoi(entry.path().filename());
    if (!is_bound_to(descriptor, port)) continue;
    ++sockets;
    if (::setsockopt(descriptor, SOL_SOCKET, SO_ATTACH_FILTER, &filter, sizeof filter) != 0)
      throw Error(because("no filter of what other machines send"));
  }
  if (sockets == 0)
    throw Error("no socket on port " + std::to_string(port) + " to shut to other machines");
}

std::string multicast_fault(const MulticastGroup& group) {
  in_addr address{};
  if (::inet_pton(AF_INET, group.address.c_str(), &address) != 1) return "no such address";
  const Socket receiver, sender;
  if (receiver.get() < 0 || sender.get() < 0) return because("no socket");
  const std::uint16_t port = join(receiver, address);
  if (port == 0) return because("no route");
  (void)sender.set(IPPROTO_IP, IP_MULTICAST_TTL, 0);
  (void)sender.set(IPPROTO_IP, IP_MULTICAST_LOOP, 1);
  const sockaddr_in to = socket_address(address, port);
  const char byte = 0;
  if (::sendto(sender.get(), &byte, 1, 0, reinterpret_cast<const sockaddr*>(&to), sizeof to) != 1) {
    return because("no route");
  }
  pollfd ready{receiver.get(), POLLIN, 0};
  if (::poll(&ready, 1, kReturnTimeoutMs) != 1) return "a datagram does not come back: firewall?";
  return "";
}

std::string multicast_remedy(const MulticastGroup& group) {
  return "ip link set lo multicast on; ip route add " + group.address + "/32 dev lo";
}

int granted_receive_buffer(int bytes) {
  const Socket socket;
  int granted = 0;
  socklen_t size = sizeof granted;
  if (!socket.set(SOL_SOCKET, SO_RCVBUF, bytes) ||
      ::getsockopt(socket.get(), SOL_SOCKET, SO_RCVBUF, &granted, &size) != 0) {
    return 0;
  }
  return granted / 2;  // the kernel counts its own share too
}

}  // namespace saker::flight
