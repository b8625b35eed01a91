#pragma once

#include <filesystem>
#include <vector>

#include "saker/core/time.h"
#include "saker/simulation/sensor/scan_points.h"

namespace saker::simulation {

/// Writes scans as SemanticKITTI lays them out: velodyne/NNNNNN.bin (float32 x y z reflectivity),
/// labels/NNNNNN.label (uint32: SemanticKITTI id, in the upper half the object), poses.txt (rows of
/// T_first_scan, KITTI's camera convention with the calib.txt beside it), times.txt. Points run
/// ring by ring from the highest beam, each from azimuth 0 leftwards.
class LabelledScanWriter {
 public:
  /// Makes the folders. Throws Error where it cannot.
  explicit LabelledScanWriter(const std::filesystem::path& folder);

  void write(const CastScan& scan, const SE3& T_world_lidar, Time stamp);
  /// The same of points in an order of their own, with ring/NNNNNN.u16 (uint16: the point's ring, 0
  /// the highest beam) beside it. `T_world_scan`: of the frame that the points are in.
  void write(const std::vector<ScanPoint>& points, const SE3& T_world_scan, Time stamp);
  /// poses.txt, times.txt and calib.txt; call it once after the last scan.
  void finish() const;

 private:
  void write(const std::vector<float>& points, const std::vector<std::uint32_t>& labels,
             const SE3& T_world_scan, Time stamp);

  std::filesystem::path folder_;
  std::vector<SE3> poses_;
  std::vector<Time> times_;
};

/// The scan's returns, ring by ring, each in order of azimuth from 0 to 2π.
[[nodiscard]] std::vector<std::size_t> ring_order(const CastScan& scan);

}  // namespace saker::simulation
