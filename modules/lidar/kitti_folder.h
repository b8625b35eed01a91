#pragma once

#include <filesystem>
#include <vector>

#include "saker/lidar/recording.h"

namespace saker::lidar {

/// A folder of KITTI scans: `*.bin` in it or in `velodyne/`, by name; x, y, z, remission as floats.
/// Times come from `times.txt` in the folder or beside it (seconds, a line a scan), else 10 Hz;
/// points have no times of their own. Ring numbers come from `ring/STEM.u8` or `ring/STEM.u16`
/// beside the scans' folder, where they are there. A file that is no whole number of points, holds
/// none or cannot be read, or whose ring numbers are not one a point, is a frame with a fault.
/// Where the first, the middle and the last scan tell that the frame is not the sensor's, every
/// scan says where the sensor was, and `note` says so.
class KittiFolder : public ScanSource {
 public:
  /// Throws Error when there are no scans, or `times.txt` does not fit them.
  explicit KittiFolder(const std::filesystem::path& folder);

  [[nodiscard]] std::optional<Frame> next() override;
  [[nodiscard]] SourceCounters counters() const override { return counters_; }
  [[nodiscard]] int expected_scans() const override { return static_cast<int>(files_.size()); }
  [[nodiscard]] std::string note() const override;
  [[nodiscard]] const std::vector<std::filesystem::path>& files() const { return files_; }

 private:
  /// \return the fault, or empty
  std::string read(const std::filesystem::path& file, Scan& scan);
  void find_origin();

  std::vector<std::filesystem::path> files_;
  std::filesystem::path rings_;  ///< folder of ring numbers, or empty
  std::vector<Time> times_;
  std::vector<float> buffer_;
  std::optional<Eigen::Isometry3f> T_lidar_sensor_;
  std::size_t next_ = 0;
  SourceCounters counters_;
};

/// True for a folder that KittiFolder can read.
[[nodiscard]] bool is_kitti_folder(const std::filesystem::path& folder);

}  // namespace saker::lidar
