#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "saker/lidar/clouds/point_layout.h"
#include "saker/lidar/recording.h"

namespace saker::lidar {

/// A folder of PCD, PLY or .npy files, one a scan, in natural order of their names; or one such
/// file. Times: scan_times.h. What the points hold: point_layout.h. A file that cannot be read, or
/// whose fields are not those of the first, is a frame with a fault.
class CloudFolder : public ScanSource {
 public:
  /// Throws Error when there are no clouds, the first cannot be read or has no x, y and z.
  explicit CloudFolder(const std::filesystem::path& path);

  [[nodiscard]] std::optional<Frame> next() override;
  [[nodiscard]] SourceCounters counters() const override { return counters_; }
  [[nodiscard]] int expected_scans() const override { return static_cast<int>(files_.size()); }
  [[nodiscard]] std::string note() const override;

 private:
  std::string read(std::size_t which, Scan& scan);

  std::vector<std::filesystem::path> files_;
  std::vector<Time> times_;
  std::optional<PointReader> reader_;
  std::optional<Eigen::Isometry3f> T_lidar_sensor_;
  std::size_t next_ = 0;
  SourceCounters counters_;
};

/// Where a folder keeps its clouds: itself or one that data sets are known to have; empty where
/// there are none.
[[nodiscard]] std::filesystem::path cloud_folder_in(const std::filesystem::path& folder);

}  // namespace saker::lidar
