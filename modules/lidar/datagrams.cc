#include "saker/lidar/datagrams.h"

#include <pcap/pcap.h>

#include <algorithm>
#include <array>

#include "saker/lidar/bytes.h"

namespace saker::lidar {
namespace {

constexpr std::size_t kEthernetHead = 14;
constexpr std::size_t kVlanTag = 4;
constexpr std::size_t kCookedHead = 16;
constexpr std::size_t kCooked2Head = 20;
constexpr std::size_t kLoopbackHead = 4;
constexpr std::size_t kUdpHead = 8;
constexpr std::size_t kIpv6Head = 40;
constexpr int kUdp = 17;
constexpr unsigned kMoreFragments = 0x2000;
constexpr unsigned kFragmentOffset = 0x1FFF;
constexpr std::size_t kFragmentUnit = 8;
constexpr std::size_t kLargestDatagram = 65535;
constexpr Time kOldestPartial = 2 * kNanosecondsPerSecond;

std::size_t ethernet_head(std::span<const std::uint8_t> packet) {
  std::size_t head = kEthernetHead;
  while (packet.size() >= head) {
    const unsigned type = read_network16(&packet[head - 2]);
    if (type != 0x8100 && type != 0x88A8 && type != 0x9100) break;
    head += kVlanTag;
  }
  return head;
}

std::size_t link_head(std::span<const std::uint8_t> packet, int link) {
  switch (link) {
    case DLT_EN10MB:
      return ethernet_head(packet);
    case DLT_LINUX_SLL:
      return kCookedHead;
    case DLT_LINUX_SLL2:
      return kCooked2Head;
    case DLT_NULL:
    case DLT_LOOP:
      return kLoopbackHead;
    default:
      return 0;
  }
}

}  // namespace

bool link_known(int link) {
  constexpr std::array kKnown = {DLT_EN10MB, DLT_LINUX_SLL, DLT_LINUX_SLL2, DLT_NULL,
                                 DLT_LOOP,   DLT_RAW,       DLT_IPV4,       DLT_IPV6};
  return std::find(kKnown.begin(), kKnown.end(), link) != kKnown.end();
}

std::span<const std::uint8_t> ip_packet(std::span<const std::uint8_t> packet, int link) {
  const std::size_t head = link_head(packet, link);
  if (!link_known(link) || packet.size() <= head) return {};
  return packet.subspan(head);
}

std::optional<Datagram> Reassembly::add(std::span<const std::uint8_t> ip, Time captured) {
  if (ip.empty()) return std::nullopt;
  if (ip[0] >> 4 == 4) return add_ipv4(ip, captured);
  if (ip[0] >> 4 == 6) return add_ipv6(ip, captured);
  return std::nullopt;
}

std::optional<Datagram> Reassembly::add_ipv4(std::span<const std::uint8_t> ip, Time captured) {
  const std::size_t head = static_cast<std::size_t>(ip[0] & 15) * 4;
  if (head < 20 || ip.size() < head || ip[9] != kUdp) return std::nullopt;
  const std::size_t length = read_network16(&ip[2]);
  if (length < head || length > ip.size()) {
    ++cut_;
    return std::nullopt;
  }
  const auto body = ip.subspan(head, length - head);
  const unsigned fragment = read_network16(&ip[6]);
  if ((fragment & (kMoreFragments | kFragmentOffset)) == 0) return udp(body, captured);
  return add_fragment(ip, body, captured);
}

std::optional<Datagram> Reassembly::add_ipv6(std::span<const std::uint8_t> ip, Time captured) {
  if (ip.size() < kIpv6Head || ip[6] != kUdp) return std::nullopt;
  const std::size_t length = read_network16(&ip[4]);
  if (kIpv6Head + length > ip.size()) {
    ++cut_;
    return std::nullopt;
  }
  return udp(ip.subspan(kIpv6Head, length), captured);
}

std::optional<Datagram> Reassembly::udp(std::span<const std::uint8_t> body, Time captured) {
  if (body.size() < kUdpHead) return std::nullopt;
  const std::size_t length = read_network16(&body[4]);
  if (length < kUdpHead || length > body.size()) {
    ++cut_;
    return std::nullopt;
  }
  return Datagram{captured, read_network16(&body[2]), body.subspan(kUdpHead, length - kUdpHead)};
}

std::optional<Datagram> Reassembly::add_fragment(std::span<const std::uint8_t> ip,
                                                 std::span<const std::uint8_t> body,
                                                 Time captured) {
  const unsigned field = read_network16(&ip[6]);
  const std::size_t first = field & kFragmentOffset;
  const std::size_t end = first * kFragmentUnit + body.size();
  const bool more = field & kMoreFragments;
  if (body.empty() || end > kLargestDatagram || (more && body.size() % kFragmentUnit != 0)) {
    ++cut_;
    return std::nullopt;
  }
  const std::size_t index = partial_for(ip, captured);
  Partial& partial = partial_[index];
  if (partial.bytes.size() < end) {
    partial.bytes.resize(end);
    partial.here.resize((end + kFragmentUnit - 1) / kFragmentUnit);
  }
  std::copy(body.begin(), body.end(), partial.bytes.begin() + first * kFragmentUnit);
  for (std::size_t unit = first; unit * kFragmentUnit < end; ++unit) {
    partial.units += !partial.here[unit];
    partial.here[unit] = true;
  }
  if (!more) partial.end = end;
  if (partial.end == 0 || partial.units < partial.here.size()) return std::nullopt;
  whole_ = std::move(partial.bytes);
  whole_.resize(partial.end);
  partial_.erase(partial_.begin() + static_cast<std::ptrdiff_t>(index));
  return udp(whole_, captured);
}

std::size_t Reassembly::partial_for(std::span<const std::uint8_t> ip, Time captured) {
  std::array<std::uint8_t, kKeyBytes> key;
  std::copy_n(&ip[12], 8, key.begin());     // both addresses
  std::copy_n(&ip[4], 2, key.begin() + 8);  // identification
  for (std::size_t i = 0; i < partial_.size(); ++i) {
    if (partial_[i].key != key) continue;
    if (captured - partial_[i].begun <= kOldestPartial) return i;
    partial_.erase(partial_.begin() + static_cast<std::ptrdiff_t>(i));  // the number was used again
    ++lost_;
    break;
  }
  if (partial_.size() >= kMostPartial) {
    partial_.pop_front();
    ++lost_;
  }
  partial_.emplace_back();
  partial_.back().key = key;
  partial_.back().begun = captured;
  return partial_.size() - 1;
}

}  // namespace saker::lidar
