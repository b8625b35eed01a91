#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "saker/lidar/capture_reader.h"
#include "saker/lidar/ouster_stream.h"
#include "saker/lidar/recording.h"

namespace saker::lidar {

/// An Ouster capture, frame by frame. One sensor a capture; other traffic is left alone.
class OusterCapture : public ScanSource {
 public:
  /// Throws Error when either file cannot be read, or no packet in the capture fits the metadata.
  OusterCapture(const std::filesystem::path& capture, const std::filesystem::path& metadata,
                bool keep_ranges = false);

  [[nodiscard]] std::optional<Frame> next() override;
  [[nodiscard]] SourceCounters counters() const override;
  [[nodiscard]] std::string sensor_name() const override { return name_and_mode(info()); }

  /// The frame with all that was decoded.
  [[nodiscard]] std::optional<OusterStream::Item> next_item();
  [[nodiscard]] const SensorInfo& info() const { return stream_.info(); }

 private:
  void read_until_item();
  void add(const Datagram& datagram);
  [[nodiscard]] std::string sizes_seen() const;

  CaptureReader reader_;
  OusterStream stream_;
  std::optional<OusterStream::Item> ahead_;
  std::map<std::size_t, int> other_sizes_;  // of datagrams to the sensor's ports; at most a few
  int bad_packets_ = 0;
};

}  // namespace saker::lidar
