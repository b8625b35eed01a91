#pragma once

#include <deque>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "saker/lidar/file_bytes.h"
#include "saker/lidar/osf/flat_table.h"
#include "saker/lidar/recording.h"
#include "saker/lidar/scan_assembler.h"

namespace saker::lidar {

/// The vendor's OSF files, version 2 (chunks of FlatBuffers): scans with the sensor's metadata.
///
/// Chunks are read from the first to the last. Inertial samples are those that scans hold
/// (osf_imu.h). Of a file that is cut the scans up to the cut are read where the metadata stand in
/// its beginning, too (firmware 3).
class OsfRecording : public ScanSource {
 public:
  /// Throws Error when it is no OSF file, has no scans or no metadata, or several sensors and
  /// `sensor` names none of them.
  explicit OsfRecording(const std::filesystem::path& file, const RecordingOptions& options = {});

  [[nodiscard]] std::optional<Frame> next() override;
  [[nodiscard]] SourceCounters counters() const override;
  [[nodiscard]] const AssembledScan* assembled() const override { return &given_; }
  [[nodiscard]] const SensorInfo& info() const { return info_; }

 private:
  [[nodiscard]] std::optional<AssembledScan> next_scan(std::string& fault);
  struct Block {
    std::string kind;  // "OSF!" a chunk, "OSF#" metadata
    std::vector<std::uint8_t> bytes;
  };
  struct Stream {
    std::uint32_t sensor = 0;
    SensorInfo info;
  };

  std::optional<Block> next_block();
  void read_metadata_block(const FlatTable& metadata, std::map<std::uint32_t, Stream>& streams);
  void read_sensor_message(ByteView message, std::map<std::uint32_t, Stream>& streams);
  void find_streams(const RecordingOptions& options);
  void choose(const std::map<std::uint32_t, Stream>& streams, const std::string& sensor);
  [[nodiscard]] std::string take_scan(const FlatTable& message);
  void take_imu(const FlatTable& message);

  std::string where_;
  FileBytes file_;
  std::uint64_t at_ = 0;
  std::uint64_t first_at_ = 0;     // of the blocks behind the header
  std::uint64_t metadata_at_ = 0;  // as the header says
  std::uint32_t stream_ = 0;       // id of the chosen one's messages
  SensorInfo info_;
  std::unique_ptr<ScanAssembler> assembler_;
  std::optional<Block> chunk_;
  std::deque<FlatTable> messages_;  // of the chunk under way
  std::deque<ImuSample> imu_;       // that wait for a scan that is not older
  Time newest_imu_ = 0;
  AssembledScan given_;
  int next_name_ = 0;
  std::string amiss_;
  SourceCounters counters_;
};

}  // namespace saker::lidar
