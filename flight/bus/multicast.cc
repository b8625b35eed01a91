#include "flight/bus/multicast.h"

#include <arpa/inet.h>
#include <linux/filter.h>
#include <linux/if_packet.h>
#include <net/if.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <regex>
#include <utility>

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

using Filter = std::vector<sock_filter>;

constexpr std::uint32_t kAll = 0xFFFFFFFF;
constexpr std::uint32_t kShortMessage = 0x4C433032;     // LCM's magic of what is in one datagram
constexpr std::uint32_t kMagicAt = 8, kChannelAt = 16;  // bytes, from the UDP header on

sock_filter load(std::uint16_t size, std::uint32_t at) {
  return BPF_STMT(static_cast<std::uint16_t>(BPF_LD | size | BPF_ABS), at);
}

/// Skips so many where it is `value`, so many else.
sock_filter skip(std::uint32_t value, std::uint8_t equal, std::uint8_t other) {
  return BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, value, equal, other);
}

sock_filter take(std::uint32_t bytes) { return BPF_STMT(BPF_RET | BPF_K, bytes); }

/// Takes what came over lo, and multicast that this machine hears of itself.
Filter machine_filter() {
  constexpr auto kAbout = static_cast<std::uint32_t>(SKF_AD_OFF);
  return {load(BPF_B, kAbout + SKF_AD_PKTTYPE),
          skip(PACKET_LOOPBACK, 3, 0),
          load(BPF_W, kAbout + SKF_AD_IFINDEX),
          skip(::if_nametoindex("lo"), 1, 0),
          take(0),
          take(kAll)};
}

/// Takes what begins with `name` and its zero, else goes on.
void add_channel(const std::string& name, Filter& filter) {
  const std::size_t size = name.size() + 1;
  const std::size_t words = size / 4, bytes = size % 4;
  for (std::size_t i = 0; i < words + bytes; ++i) {
    const std::size_t at = i < words ? 4 * i : 4 * words + (i - words);
    const auto byte = [&](std::size_t k) {
      return std::uint32_t{static_cast<std::uint8_t>(name.c_str()[k])};
    };
    const std::uint32_t value =
        i < words ? byte(at) << 24 | byte(at + 1) << 16 | byte(at + 2) << 8 | byte(at + 3)
                  : byte(at);
    const auto rest = static_cast<std::uint8_t>(2 * (words + bytes - i - 1) + 1);
    filter.push_back(load(i < words ? BPF_W : BPF_B, kChannelAt + static_cast<std::uint32_t>(at)));
    filter.push_back(skip(value, 0, rest));
  }
  filter.push_back(take(kAll));
}

/// Short names first: a load beyond a datagram's end drops it.
Filter channel_filter(std::vector<std::string> channels) {
  std::sort(channels.begin(), channels.end(),
            [](const auto& a, const auto& b) { return a.size() < b.size(); });
  Filter filter = machine_filter();
  filter.back() = load(BPF_W, kMagicAt);
  filter.push_back(skip(kShortMessage, 1, 0));
  filter.push_back(take(kAll));
  for (const std::string& name : channels) add_channel(name, filter);
  filter.push_back(take(0));
  return filter;
}

void filter_sockets(std::uint16_t port, Filter filter) {
  const sock_fprog program{static_cast<unsigned short>(filter.size()), filter.data()};
  int sockets = 0;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
    const int descriptor = std::stoi(entry.path().filename());
    if (!is_bound_to(descriptor, port)) continue;
    ++sockets;
    if (::setsockopt(descriptor, SOL_SOCKET, SO_ATTACH_FILTER, &program, sizeof program) != 0)
      throw Error(because("no filter of what is not for this process"));
  }
  if (sockets == 0) throw Error("no socket on port " + std::to_string(port) + " to filter");
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

void hear_this_machine_alone(std::uint16_t port) { filter_sockets(port, machine_filter()); }

void hear_channels_alone(std::uint16_t port, std::vector<std::string> channels) {
  static const std::regex kName("[A-Z0-9_]+");
  for (const std::string& name : channels)
    if (!std::regex_match(name, kName))
      throw Error("channel " + name + " to hear alone, expected capitals, digits and _");
  filter_sockets(port, channel_filter(std::move(channels)));
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
