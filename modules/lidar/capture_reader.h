#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "saker/lidar/datagrams.h"

struct pcap;

namespace saker::lidar {

/// The UDP datagrams of a capture file (pcap or pcapng), whole ones only.
class CaptureReader {
 public:
  /// Throws Error when the file cannot be opened or has a link type without IP.
  explicit CaptureReader(const std::filesystem::path& file);

  /// Nothing at the end; the payload stays until the next call.
  [[nodiscard]] std::optional<Datagram> next();

  /// Why reading ended before the file's end; empty when it did not.
  [[nodiscard]] const std::string& ended_early() const { return ended_early_; }
  [[nodiscard]] int lost_datagrams() const;  ///< fragments were missing
  [[nodiscard]] int cut_packets() const { return reassembly_.cut(); }

 private:
  struct Closer {
    void operator()(pcap* handle) const;
  };

  std::unique_ptr<pcap, Closer> handle_;
  int link_ = 0;
  bool over_ = false;
  Reassembly reassembly_;
  std::string ended_early_;
};

}  // namespace saker::lidar
