#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "saker/lidar/clouds/float_rows.h"
#include "saker/lidar/clouds/point_layout.h"
#include "saker/lidar/recording.h"

namespace saker::lidar {

/// A folder of scans as KITTI has them: `*.bin` in it, in `velodyne/` or in
/// `velodyne_points/data/`, in natural order of their names; x, y, z, remission as floats, or
/// whatever the data say (clouds/float_rows.h). Or one such file. Times: clouds/scan_times.h.
/// Points have no times of their own, but where the data hold them. Ring numbers come from
/// `ring/STEM.u8` or `ring/STEM.u16` beside the scans' folder, where they are there. A file that is
/// no whole number of points, holds none or cannot be read, or whose ring numbers are not one a
/// point, is a frame with a fault. Where the first, the middle and the last scan tell that the
/// frame is not the sensor's, every scan says where the sensor was, and `note` says so.
class KittiFolder : public ScanSource {
 public:
  /// Throws Error when there are no scans, or `times.txt` does not fit them.
  /// \param point_fields  "x,y,z,i,ring": what a point is; found from the data where it is empty
  explicit KittiFolder(const std::filesystem::path& path, const std::string& point_fields = {});

  [[nodiscard]] std::optional<Frame> next() override;
  [[nodiscard]] SourceCounters counters() const override { return counters_; }
  [[nodiscard]] int expected_scans() const override { return static_cast<int>(files_.size()); }
  [[nodiscard]] std::string note() const override;
  [[nodiscard]] const std::vector<std::filesystem::path>& files() const { return files_; }

 private:
  /// \return the fault, or empty
  std::string read(std::size_t which, Scan& scan);

  std::vector<std::filesystem::path> files_;
  std::filesystem::path rings_;  ///< folder of ring numbers, or empty
  std::vector<Time> times_;
  FloatFields fields_;
  std::optional<PointReader> reader_;  ///< where the fields are not KITTI's
  std::vector<float> buffer_;
  std::optional<Eigen::Isometry3f> T_lidar_sensor_;
  std::size_t next_ = 0;
  SourceCounters counters_;
};

/// True for a folder that KittiFolder can read.
[[nodiscard]] bool is_kitti_folder(const std::filesystem::path& folder);

}  // namespace saker::lidar
