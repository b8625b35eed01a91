#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "saker/lidar/datagrams.h"

struct pcap;

namespace saker::lidar {

/// The UDP datagrams of a capture (pcap or pcapng), whole ones only; of files that follow one
/// another as one.
class CaptureReader {
 public:
  /// Throws Error when the first file cannot be opened or has a link type without IP.
  explicit CaptureReader(std::vector<std::filesystem::path> files);
  explicit CaptureReader(const std::filesystem::path& file)
      : CaptureReader(std::vector<std::filesystem::path>{file}) {}

  /// Nothing at the end; the payload stays until the next call.
  [[nodiscard]] std::optional<Datagram> next();

  /// Why reading ended before a file's end; empty when it did not.
  [[nodiscard]] const std::string& ended_early() const { return ended_early_; }
  [[nodiscard]] int lost_datagrams() const;  ///< fragments were missing
  [[nodiscard]] int cut_packets() const { return reassembly_.cut(); }

 private:
  struct Closer {
    void operator()(pcap* handle) const;
  };

  void open(const std::filesystem::path& file);
  [[nodiscard]] bool open_next();

  std::vector<std::filesystem::path> files_;
  std::size_t next_file_ = 0;
  std::unique_ptr<pcap, Closer> handle_;
  int link_ = 0;
  bool over_ = false;
  Reassembly reassembly_;
  std::string ended_early_;
};

}  // namespace saker::lidar
