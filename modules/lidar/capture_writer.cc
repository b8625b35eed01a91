#include "saker/lidar/capture_writer.h"

#include <algorithm>
#include <array>
#include <string>

#include "saker/core/error.h"
#include "saker/lidar/bytes.h"

namespace saker::lidar {
namespace {

constexpr std::size_t kIpHead = 20;
constexpr std::size_t kUdpHead = 8;
constexpr std::size_t kEthernetHead = 14;
constexpr std::size_t kRecordHead = 16;
constexpr std::size_t kLargestPayload = 65507;
constexpr int kSmallestMtu = 68;  // RFC 791
constexpr std::uint32_t kPcapMagic = 0xA1B2C3D4;
constexpr std::uint32_t kLinkEthernet = 1;
constexpr std::uint32_t kSnapLength = 262144;

constexpr std::array<std::uint8_t, kEthernetHead> kEthernet = {2, 0, 0, 0, 0, 1, 2,
                                                               0, 0, 0, 0, 2, 8, 0};
constexpr std::array<std::uint8_t, 8> kAddresses = {192, 168, 1, 10, 192, 168, 1, 1};

std::uint16_t internet_checksum(std::span<const std::uint8_t> head) {
  std::uint32_t sum = 0;
  for (std::size_t i = 0; i + 1 < head.size(); i += 2) sum += read_network16(&head[i]);
  while (sum >> 16) sum = (sum & 0xFFFF) + (sum >> 16);
  return static_cast<std::uint16_t>(~sum);
}

void write_ip_head(std::uint8_t* ip, std::size_t body, unsigned identification, unsigned fragment) {
  std::fill_n(ip, kIpHead, std::uint8_t{0});
  ip[0] = 0x45;
  write_network16(static_cast<unsigned>(kIpHead + body), ip + 2);
  write_network16(identification, ip + 4);
  write_network16(fragment, ip + 6);
  ip[8] = 64;  // time to live
  ip[9] = 17;  // UDP
  std::copy(kAddresses.begin(), kAddresses.end(), ip + 12);
  write_network16(internet_checksum({ip, kIpHead}), ip + 10);
}

}  // namespace

CaptureWriter::CaptureWriter(const std::filesystem::path& file, int mtu)
    : out_(file),
      fragment_bytes_((static_cast<std::size_t>(std::max(mtu, kSmallestMtu)) - kIpHead) / 8 * 8) {
  std::array<std::uint8_t, 24> head = {};
  write_little(kPcapMagic, &head[0]);
  write_little(std::uint16_t{2}, &head[4]);
  write_little(std::uint16_t{4}, &head[6]);
  write_little(kSnapLength, &head[16]);
  write_little(kLinkEthernet, &head[20]);
  out_.write(head);
}

void CaptureWriter::write(Time captured, int port, std::span<const std::uint8_t> payload) {
  if (payload.size() > kLargestPayload) {
    throw Error("a datagram of " + std::to_string(payload.size()) + " bytes, expected at most " +
                std::to_string(kLargestPayload));
  }
  datagram_.assign(kUdpHead, 0);  // a checksum of 0: none
  write_network16(static_cast<unsigned>(port), &datagram_[0]);
  write_network16(static_cast<unsigned>(port), &datagram_[2]);
  write_network16(static_cast<unsigned>(kUdpHead + payload.size()), &datagram_[4]);
  datagram_.insert(datagram_.end(), payload.begin(), payload.end());
  ++identification_;
  for (std::size_t at = 0; at < datagram_.size(); at += fragment_bytes_) {
    const std::size_t size = std::min(fragment_bytes_, datagram_.size() - at);
    write_packet(captured, {&datagram_[at], size}, at, at + size < datagram_.size());
  }
}

void CaptureWriter::write_packet(Time captured, std::span<const std::uint8_t> body,
                                 std::size_t offset, bool more) {
  const auto size = static_cast<std::uint32_t>(kEthernetHead + kIpHead + body.size());
  packet_.assign(kRecordHead + kEthernetHead + kIpHead, 0);
  write_little(static_cast<std::uint32_t>(captured / kNanosecondsPerSecond), &packet_[0]);
  write_little(static_cast<std::uint32_t>(captured % kNanosecondsPerSecond / 1000), &packet_[4]);
  write_little(size, &packet_[8]);
  write_little(size, &packet_[12]);
  std::copy(kEthernet.begin(), kEthernet.end(), &packet_[kRecordHead]);
  write_ip_head(&packet_[kRecordHead + kEthernetHead], body.size(), identification_,
                static_cast<unsigned>(offset / 8) | (more ? 0x2000U : 0U));
  packet_.insert(packet_.end(), body.begin(), body.end());
  out_.write(packet_);
}

void CaptureWriter::finish() { out_.finish(); }

}  // namespace saker::lidar
