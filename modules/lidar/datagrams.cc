#include "saker/lidar/datagrams.h"

#include <pcap/pcap.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <utility>

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
constexpr int kHopByHop = 0, kRouting = 43, kIpv6Fragment = 44, kDestinationOptions = 60;
constexpr std::size_t kExtensionUnit = 8;
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

IpAddress mapped(const std::uint8_t* version4) {
  IpAddress address = {};
  address[10] = address[11] = 0xFF;
  std::copy_n(version4, 4, address.begin() + 12);
  return address;
}

constexpr std::size_t kGroups = 8;  // of four digits, in an address of version 6

/// The first of the longest runs of groups that are 0: its first and the one behind its last; an
/// empty run where there is none of at least two.
std::pair<std::size_t, std::size_t> longest_zeros(const IpAddress& address) {
  std::pair<std::size_t, std::size_t> longest = {0, 0};
  for (std::size_t begin = 0; begin < kGroups; ++begin) {
    std::size_t end = begin;
    while (end < kGroups && read_network16(&address[2 * end]) == 0) ++end;
    if (end - begin >= 2 && end - begin > longest.second - longest.first) longest = {begin, end};
  }
  return longest;
}

}  // namespace

std::string to_string(const IpAddress& address) {
  std::string text;
  if (std::equal(address.begin(), address.begin() + 12, mapped(&address[12]).begin())) {
    for (std::size_t i = 12; i < 16; ++i) {
      if (i > 12) text += '.';
      text += std::to_string(int{address[i]});
    }
    return text;
  }
  const auto [zeros, end] = longest_zeros(address);
  for (std::size_t i = 0; i < kGroups; ++i) {
    if (i == zeros && end > zeros) {
      text += "::";
      i = end - 1;
      continue;
    }
    std::array<char, 8> group = {};
    std::snprintf(group.data(), group.size(), "%x", read_network16(&address[2 * i]));
    if (!text.empty() && text.back() != ':') text += ':';
    text += group.data();
  }
  return text;
}

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
  Fragment fragment;
  fragment.source = mapped(&ip[12]);
  const unsigned field = read_network16(&ip[6]);
  if ((field & (kMoreFragments | kFragmentOffset)) == 0) {
    return udp(body, fragment.source, captured);
  }
  std::copy_n(&ip[12], 8, fragment.key.begin());     // both addresses
  std::copy_n(&ip[4], 2, fragment.key.begin() + 8);  // identification
  fragment.first = field & kFragmentOffset;
  fragment.more = field & kMoreFragments;
  fragment.body = body;
  return add_fragment(fragment, captured);
}

std::optional<Datagram> Reassembly::add_ipv6(std::span<const std::uint8_t> ip, Time captured) {
  if (ip.size() < kIpv6Head) return std::nullopt;
  int next = ip[6];
  const std::size_t length = read_network16(&ip[4]);
  Fragment fragment;
  std::copy_n(&ip[8], 16, fragment.source.begin());
  std::size_t at = kIpv6Head;
  while (next == kHopByHop || next == kRouting || next == kDestinationOptions) {
    if (ip.size() < at + kExtensionUnit) return std::nullopt;
    next = ip[at];
    at += (ip[at + 1] + std::size_t{1}) * kExtensionUnit;
  }
  if (next != kUdp && next != kIpv6Fragment) return std::nullopt;
  if (kIpv6Head + length > ip.size() || at > kIpv6Head + length) {
    ++cut_;
    return std::nullopt;
  }
  fragment.body = ip.subspan(at, kIpv6Head + length - at);
  if (next == kUdp) return udp(fragment.body, fragment.source, captured);
  if (fragment.body.size() < kExtensionUnit || fragment.body[0] != kUdp) return std::nullopt;
  const unsigned field = read_network16(&fragment.body[2]);
  fragment.first = field >> 3;
  fragment.more = field & 1;
  std::copy_n(&ip[8], 32, fragment.key.begin());
  std::copy_n(&fragment.body[4], 4, fragment.key.begin() + 32);
  fragment.body = fragment.body.subspan(kExtensionUnit);
  return add_fragment(fragment, captured);
}

std::optional<Datagram> Reassembly::udp(std::span<const std::uint8_t> body, const IpAddress& source,
                                        Time captured) {
  if (body.size() < kUdpHead) return std::nullopt;
  const std::size_t length = read_network16(&body[4]);
  if (length < kUdpHead || length > body.size()) {
    ++cut_;
    return std::nullopt;
  }
  return Datagram{captured, read_network16(&body[2]), source,
                  body.subspan(kUdpHead, length - kUdpHead)};
}

std::optional<Datagram> Reassembly::add_fragment(const Fragment& fragment, Time captured) {
  const auto body = fragment.body;
  const std::size_t first = fragment.first;
  const std::size_t end = first * kFragmentUnit + body.size();
  const bool more = fragment.more;
  if (body.empty() || end > kLargestDatagram || (more && body.size() % kFragmentUnit != 0)) {
    ++cut_;
    return std::nullopt;
  }
  const std::size_t index = partial_for(fragment.key, captured);
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
  return udp(whole_, fragment.source, captured);
}

std::size_t Reassembly::partial_for(const Key& key, Time captured) {
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
