#include "saker/lidar/datagrams.h"

#include <gtest/gtest.h>
#include <pcap/pcap.h>

#include <algorithm>
#include <numeric>

#include "made_sensor.h"
#include "saker/core/rng.h"
#include "saker/lidar/bytes.h"

namespace saker::lidar {
namespace {

using testing::Bytes;

Bytes payload(std::size_t size) {
  Bytes bytes(size);
  std::iota(bytes.begin(), bytes.end(), std::uint8_t{1});
  return bytes;
}

Bytes udp(const Bytes& data) {
  Bytes bytes(8 + data.size(), 0);
  write_network16(7502, &bytes[2]);
  write_network16(static_cast<unsigned>(8 + data.size()), &bytes[4]);
  std::ranges::copy(data, bytes.begin() + 8);
  return bytes;
}

Bytes ipv4(const Bytes& body, unsigned identification = 1, unsigned fragment = 0) {
  Bytes bytes(20 + body.size(), 0);
  bytes[0] = 0x45;
  write_network16(static_cast<unsigned>(20 + body.size()), &bytes[2]);
  write_network16(identification, &bytes[4]);
  write_network16(fragment, &bytes[6]);
  bytes[9] = 17;
  bytes[12] = 10;
  std::ranges::copy(body, bytes.begin() + 20);
  return bytes;
}

/// Pieces of 800 bytes.
std::vector<Bytes> fragments(const Bytes& data, unsigned identification) {
  const Bytes whole = udp(data);
  std::vector<Bytes> pieces;
  for (std::size_t at = 0; at < whole.size(); at += 800) {
    const std::size_t end = std::min(whole.size(), at + 800);
    const unsigned more = end < whole.size() ? 0x2000 : 0;
    pieces.push_back(ipv4({whole.begin() + at, whole.begin() + end}, identification,
                          static_cast<unsigned>(at / 8) | more));
  }
  return pieces;
}

Bytes with_head(std::size_t size, std::initializer_list<std::pair<std::size_t, unsigned>> words,
                const Bytes& ip) {
  Bytes bytes(size + ip.size(), 0);
  for (const auto& [at, value] : words) write_network16(value, &bytes[at]);
  std::ranges::copy(ip, bytes.begin() + static_cast<std::ptrdiff_t>(size));
  return bytes;
}

TEST(IpPacket, IsFoundBehindEveryKindOfLink) {
  const Bytes ip = ipv4(udp(payload(48)));
  const std::vector<std::pair<int, Bytes>> packets = {
      {DLT_EN10MB, with_head(14, {{12, 0x0800}}, ip)},
      {DLT_EN10MB, with_head(18, {{12, 0x8100}, {16, 0x0800}}, ip)},
      {DLT_EN10MB, with_head(22, {{12, 0x88A8}, {16, 0x8100}, {20, 0x0800}}, ip)},
      {DLT_LINUX_SLL, with_head(16, {{14, 0x0800}}, ip)},
      {DLT_LINUX_SLL2, with_head(20, {{0, 0x0800}}, ip)},
      {DLT_NULL, with_head(4, {{0, 0x0200}}, ip)},
      {DLT_RAW, ip}};
  for (const auto& [link, packet] : packets) {
    const auto found = ip_packet(packet, link);
    EXPECT_TRUE(std::equal(found.begin(), found.end(), ip.begin(), ip.end())) << link;
  }
  EXPECT_FALSE(link_known(DLT_IEEE802_11));
}

TEST(Reassembly, AWholeDatagramPassesThrough) {
  Reassembly reassembly;
  const Bytes ip = ipv4(udp(payload(48)));
  const auto datagram = reassembly.add(ip, 5);
  ASSERT_TRUE(datagram);
  EXPECT_EQ(datagram->port, 7502);
  EXPECT_TRUE(std::ranges::equal(datagram->payload, payload(48)));
}

TEST(Reassembly, IgnoresThePaddingOfEthernet) {
  Reassembly reassembly;
  Bytes ip = ipv4(udp(payload(4)));
  ip.resize(46);
  const auto datagram = reassembly.add(ip, 0);
  ASSERT_TRUE(datagram);
  EXPECT_EQ(datagram->payload.size(), 4U);
}

TEST(Reassembly, FragmentsMayComeInAnyOrderAndTwice) {
  core::Rng rng(1);
  for (int trial = 0; trial < 50; ++trial) {
    Reassembly reassembly;
    auto pieces = fragments(payload(8448), 9);
    pieces.insert(pieces.begin(), pieces[trial % pieces.size()]);
    for (std::size_t i = pieces.size() - 1; i > 0; --i) {
      std::swap(pieces[i], pieces[rng.index(static_cast<int>(i) + 1)]);
    }
    int whole = 0;
    for (const Bytes& piece : pieces) {
      const auto datagram = reassembly.add(piece, 0);
      if (!datagram) continue;
      ++whole;
      EXPECT_TRUE(std::ranges::equal(datagram->payload, payload(8448)));
    }
    EXPECT_EQ(whole, 1);
  }
}

TEST(Reassembly, InterleavedDatagramsAreKeptApart) {
  Reassembly reassembly;
  const auto a = fragments(payload(3000), 1);
  const auto b = fragments(payload(2500), 2);
  std::vector<std::size_t> sizes;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (const auto* pieces : {&a, &b}) {
      if (const auto datagram = reassembly.add((*pieces)[i], 0)) {
        sizes.push_back(datagram->payload.size());
      }
    }
  }
  EXPECT_EQ(sizes, (std::vector<std::size_t>{3000, 2500}));
}

TEST(Reassembly, AMissingFragmentLosesOnlyItsDatagram) {
  Reassembly reassembly;
  auto broken = fragments(payload(3000), 1);
  broken.erase(broken.begin() + 1);
  for (const Bytes& piece : broken) EXPECT_FALSE(reassembly.add(piece, 0));
  bool whole = false;
  for (const Bytes& piece : fragments(payload(3000), 2)) {
    whole = reassembly.add(piece, 0).has_value();
  }
  EXPECT_TRUE(whole);
  EXPECT_EQ(reassembly.unfinished(), 1);
}

TEST(Reassembly, HoldsAtMostItsCeiling) {
  Reassembly reassembly;
  for (unsigned i = 0; i < 1000; ++i) (void)reassembly.add(fragments(payload(3000), i)[0], 0);
  EXPECT_EQ(reassembly.unfinished(), static_cast<int>(Reassembly::kMostPartial));
  EXPECT_EQ(reassembly.lost(), 1000 - static_cast<int>(Reassembly::kMostPartial));
}

TEST(Reassembly, AnIdentificationUsedAgainLaterBeginsANewDatagram) {
  Reassembly reassembly;
  const auto pieces = fragments(payload(3000), 1);
  (void)reassembly.add(pieces[0], 0);
  for (std::size_t i = 1; i < pieces.size(); ++i) {
    EXPECT_FALSE(reassembly.add(pieces[i], 10 * kNanosecondsPerSecond));
  }
  EXPECT_EQ(reassembly.lost(), 1);
}

TEST(Reassembly, CutAndDamagedPacketsNeverGiveMoreThanTheyHold) {
  core::Rng rng(4);
  Reassembly reassembly;
  const auto pieces = fragments(payload(5000), 3);
  for (int trial = 0; trial < 20000; ++trial) {
    Bytes piece = pieces[rng.index(static_cast<int>(pieces.size()))];
    for (int flips = rng.index(4); flips > 0; --flips) {
      piece[rng.index(28)] = static_cast<std::uint8_t>(rng.index(256));
    }
    if (rng.chance(0.3)) piece.resize(rng.index(static_cast<int>(piece.size()) + 1));
    const auto datagram = reassembly.add(piece, trial);
    ASSERT_LE(datagram ? datagram->payload.size() : 0, 65535U);
    (void)ip_packet(piece, DLT_EN10MB);
  }
}

/// One fragment of a UDP datagram over IPv6.
Bytes ipv6_fragment(const Bytes& body, std::size_t offset, bool more, std::uint8_t source) {
  Bytes bytes(48 + body.size(), 0);
  bytes[0] = 0x60;
  write_network16(static_cast<unsigned>(8 + body.size()), &bytes[4]);
  bytes[6] = 44;
  bytes[8] = 0xFE;
  bytes[9] = 0x80;
  bytes[23] = source;
  bytes[40] = 17;
  write_network16(static_cast<unsigned>(offset) | (more ? 1 : 0), &bytes[42]);
  bytes[47] = 9;  // identification
  std::ranges::copy(body, bytes.begin() + 48);
  return bytes;
}

TEST(Reassembly, FragmentsOfIpv6AreJoinedBySourceInAnyOrder) {
  const Bytes data = payload(1992), whole = udp(data);
  const Bytes first(whole.begin(), whole.begin() + 1200), second(whole.begin() + 1200, whole.end());
  Reassembly reassembly;
  EXPECT_FALSE(reassembly.add(ipv6_fragment(second, 1200, false, 1), 0));
  EXPECT_FALSE(reassembly.add(ipv6_fragment(first, 0, true, 2), 0));  // of another sensor
  const Bytes last = ipv6_fragment(first, 0, true, 1);
  const auto datagram = reassembly.add(last, 0);
  ASSERT_TRUE(datagram);
  EXPECT_TRUE(std::ranges::equal(datagram->payload, data));
  EXPECT_EQ(to_string(datagram->source), "fe80::1");
  EXPECT_EQ(reassembly.unfinished(), 1);
}

TEST(Reassembly, SaysWhereADatagramComesFrom) {
  Reassembly reassembly;
  const Bytes ip = ipv4(udp(payload(48)));
  const auto datagram = reassembly.add(ip, 5);
  ASSERT_TRUE(datagram);
  EXPECT_EQ(to_string(datagram->source), "10.0.0.0");
}

}  // namespace
}  // namespace saker::lidar
