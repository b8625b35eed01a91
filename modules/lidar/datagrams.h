#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "saker/core/time.h"

/// UDP datagrams out of captured link-layer packets.
namespace saker::lidar {

/// Of version 6, or of version 4 in its last four bytes behind 0xFFFF.
using IpAddress = std::array<std::uint8_t, 16>;

/// "10.0.0.1", "fe80::1".
[[nodiscard]] std::string to_string(const IpAddress& address);

struct Datagram {
  Time captured = 0;  ///< by the clock of the machine that captured it
  int port = 0;       ///< destination
  IpAddress source = {};
  std::span<const std::uint8_t> payload;
};

/// The IP packet inside a captured one: Ethernet (with VLAN tags), Linux cooked (both versions),
/// raw IP, loopback. `link` is libpcap's DLT; empty when it is none, or of an unknown link type.
[[nodiscard]] std::span<const std::uint8_t> ip_packet(std::span<const std::uint8_t> packet,
                                                      int link);
[[nodiscard]] bool link_known(int link);

/// Takes IP packets, gives UDP datagrams; puts fragmented datagrams together in whatever order
/// their fragments come. At most `kMostPartial` datagrams are under way; the oldest is given up, as
/// is one 2 s old.
class Reassembly {
 public:
  static constexpr std::size_t kMostPartial = 64;

  /// The payload points into `packet` or into this object, until the next call.
  [[nodiscard]] std::optional<Datagram> add(std::span<const std::uint8_t> ip, Time captured);

  [[nodiscard]] int lost() const { return lost_; }  ///< datagrams given up
  [[nodiscard]] int cut() const { return cut_; }    ///< packets shorter than they say
  [[nodiscard]] int unfinished() const { return static_cast<int>(partial_.size()); }

 private:
  static constexpr std::size_t kKeyBytes = 36;

  using Key = std::array<std::uint8_t, kKeyBytes>;  // addresses and identification

  struct Fragment {
    Key key = {};
    IpAddress source = {};
    std::size_t first = 0;  // in units of eight bytes
    bool more = false;      // this one is not the last
    std::span<const std::uint8_t> body;
  };

  struct Partial {
    Key key;
    std::vector<std::uint8_t> bytes;
    std::vector<bool> here;  // units of eight bytes
    std::size_t units = 0;
    std::size_t end = 0;  // 0: the last fragment has not come
    Time begun = 0;
  };

  [[nodiscard]] std::optional<Datagram> add_ipv4(std::span<const std::uint8_t> ip, Time captured);
  [[nodiscard]] std::optional<Datagram> add_ipv6(std::span<const std::uint8_t> ip, Time captured);
  [[nodiscard]] std::optional<Datagram> add_fragment(const Fragment& fragment, Time captured);
  [[nodiscard]] std::optional<Datagram> udp(std::span<const std::uint8_t> body,
                                            const IpAddress& source, Time captured);
  [[nodiscard]] std::size_t partial_for(const Key& key, Time captured);

  std::deque<Partial> partial_;  // oldest first
  std::vector<std::uint8_t> whole_;
  int lost_ = 0;
  int cut_ = 0;
};

}  // namespace saker::lidar
