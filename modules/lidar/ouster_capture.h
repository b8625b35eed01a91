#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "saker/lidar/capture_reader.h"
#include "saker/lidar/ouster_senders.h"
#include "saker/lidar/ouster_stream.h"
#include "saker/lidar/recording.h"

namespace saker::lidar {

/// One Ouster sensor of a capture, frame by frame; other traffic is left alone.
class OusterCapture : public ScanSource {
 public:
  /// Throws Error when either file cannot be read, when no packet in the capture fits the metadata,
  /// when several sensors are in it and `sensor` (a serial number or an address) names none, and
  /// when the sensor's serial number is another than the metadata's.
  /// Files that follow one another are one capture.
  OusterCapture(const std::vector<std::filesystem::path>& files,
                const std::filesystem::path& metadata, bool keep_ranges = false,
                const std::string& sensor = {});
  OusterCapture(const std::filesystem::path& capture, const std::filesystem::path& metadata,
                bool keep_ranges = false, const std::string& sensor = {})
      : OusterCapture(std::vector<std::filesystem::path>{capture}, metadata, keep_ranges, sensor) {}

  [[nodiscard]] std::optional<Frame> next() override;
  [[nodiscard]] SourceCounters counters() const override;
  [[nodiscard]] std::string sensor_name() const override { return name_and_mode(info()); }
  [[nodiscard]] std::string note() const override;
  [[nodiscard]] const AssembledScan* assembled() const override { return &given_; }

  /// The frame with all that was decoded.
  [[nodiscard]] std::optional<OusterStream::Item> next_item();
  [[nodiscard]] const SensorInfo& info() const { return stream_.info(); }

 private:
  void read_until_item();
  void add(const Datagram& datagram);
  [[nodiscard]] bool from_another(const Datagram& datagram) const;
  [[nodiscard]] std::string sizes_seen() const;

  CaptureReader reader_;
  OusterStream stream_;
  std::optional<OusterSender> only_;  // where there are several
  std::optional<OusterStream::Item> ahead_;
  AssembledScan given_;
  std::map<std::size_t, int> other_sizes_;  // of datagrams to the sensor's ports; at most a few
  int bad_packets_ = 0;
  int other_sensors_ = 0;
};

}  // namespace saker::lidar
