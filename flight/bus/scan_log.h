#pragma once

#include <filesystem>
#include <lcm/lcm-cpp.hpp>
#include <optional>
#include <string>

#include "flight/bus/scan_messages.h"
#include "saker/lidar/recording.h"

namespace saker::flight {

/// Scans of a flown mission: the `_SCAN` messages in a log of lcm-logger, which has to listen to
/// the bulk network (bus.bulk_url).
///
/// The scans are deskewed already, so that their points need no times, quantised to 1 cm, not
/// organised, without inertial samples; their registered poses and the points that stand for open
/// beams are left out, so that a replay registers and labels what the sensor saw. Counted
/// and passed over: messages that cannot be decoded (bad_packets), scans of which a chunk is
/// missing (lost_frames).
class ScanLog : public lidar::ScanSource {
 public:
  /// Reads the log once to count. Throws Error when there are no scans in it or those of several
  /// robots.
  explicit ScanLog(const std::filesystem::path& file);

  [[nodiscard]] std::optional<lidar::Frame> next() override;
  [[nodiscard]] lidar::SourceCounters counters() const override;
  [[nodiscard]] int expected_scans() const override { return expected_; }
  [[nodiscard]] const std::string& channel() const { return channel_; }

 private:
  std::string channel_;
  int expected_ = 0;
  lcm::LogFile log_;
  ScanJoiner joiner_;
  int scans_ = 0;
  int malformed_ = 0;
};

/// True for a log of lcm-logger, by its first bytes.
[[nodiscard]] bool is_lcm_log(const std::filesystem::path& file);

}  // namespace saker::flight
