#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "saker/core/files.h"
#include "saker/core/time.h"

namespace saker::lidar {

/// Writes UDP datagrams as a capture (pcap, Ethernet, IPv4), as if a sensor had sent them;
/// datagrams over the MTU become fragments, as on a real network. The file appears when `finish` is
/// called.
class CaptureWriter {
 public:
  static constexpr int kEthernetMtu = 1500;
  static constexpr int kNoFragments = 65535;  ///< of a network with large frames

  /// Throws Error when the file cannot be written; so do the others.
  explicit CaptureWriter(const std::filesystem::path& file, int mtu = kEthernetMtu);

  /// At most 65507 bytes of payload.
  void write(Time captured, int port, std::span<const std::uint8_t> payload);
  void finish();

 private:
  void write_packet(Time captured, std::span<const std::uint8_t> body, std::size_t offset,
                    bool more);

  core::OutputFile out_;
  std::size_t fragment_bytes_;
  std::uint16_t identification_ = 0;
  std::vector<std::uint8_t> datagram_;
  std::vector<std::uint8_t> packet_;
};

}  // namespace saker::lidar
