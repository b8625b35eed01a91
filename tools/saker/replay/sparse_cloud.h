#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "saker/autonomy/plant.h"

namespace saker::tools {

/// Some points of each scan of a run, for pictures and recordings: enough to see walls after a few
/// scans. Once it holds a million (16 MB) later scans add none.
class SparseCloud {
 public:
  /// \param per_scan  points of a scan, about
  explicit SparseCloud(std::size_t per_scan) : per_scan_(per_scan) {}

  void reserve(std::size_t scans);

  /// The next scan, which may have no points. \param points  lidar frame, m; what is not finite is
  /// left out
  void add(std::span<const Eigen::Vector3f> points);

  /// All of them in `world`. \param T_world_lidar  of each scan, from the first one on
  [[nodiscard]] std::vector<Eigen::Vector3d> in_world(const std::vector<SE3>& T_world_lidar) const;

  /// A scan each in its order, those without points left out; their `odom` is the frame `world`.
  [[nodiscard]] std::vector<autonomy::RegisteredScan> scans(
      std::span<const Time> stamps, const std::vector<SE3>& T_world_lidar) const;

 private:
  static constexpr std::size_t kMostPoints = 1'000'000;

  struct Point {
    std::uint32_t scan;  ///< number of the scan
    Eigen::Vector3f in_lidar;
  };

  std::size_t per_scan_;
  std::uint32_t scans_ = 0;
  std::vector<Point> points_;
};

}  // namespace saker::tools
