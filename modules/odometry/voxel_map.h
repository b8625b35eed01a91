#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "saker/core/config.h"
#include "saker/core/se3.h"
#include "saker/core/time.h"
#include "saker/odometry/voxel_index.h"

namespace saker::odometry {

struct VoxelMapConfig {
  double voxel_m = 0.6;
  double max_distance_m = 80;
  double max_age_s = 120;
  int max_voxels = 200000;
  int max_points = 400;
  int min_points = 6;
  double max_thickness_m = 0.06;
  double min_breadth_m = 0.06;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("voxel_m", voxel_m, {0.1, 5}, "m",
            "edge of a voxel: what is flat at this scale is a plane");
    v.field("max_distance_m", max_distance_m, {5, 500}, "m",
            "voxels farther from the sensor are dropped");
    v.field("max_age_s", max_age_s, {1, 3600}, "s", "voxels not seen for so long are dropped");
    v.field("max_voxels", max_voxels, {1000, 4e6}, "",
            "ceiling of the map; the longest unseen go first; 150 B each");
    v.field("max_points", max_points, {10, 1e6}, "",
            "a voxel takes no more points: its plane no longer moves, nor drifts");
    v.field("min_points", min_points, {4, 100}, "", "points that make a plane");
    v.field("max_thickness_m", max_thickness_m, {0.005, 1}, "m",
            "sd along the normal of what still is a plane");
    v.field("min_breadth_m", min_breadth_m, {0.005, 1}, "m",
            "sd along a plane's shorter side: less is a line");
  }
};

/// A plane of the local map, in `odom`.
struct Plane {
  Eigen::Vector3d point;   ///< mean of what was seen
  Eigen::Vector3d normal;  ///< unit
  double variance = 0;     ///< of the points along the normal, m²
  Time first_seen = 0;     ///< any point of it
  /// What the fit leaves open of the normal: with independent points it is off by
  /// sqrt(variance) · tilt · N(0, I); 1/m.
  Eigen::Matrix<double, 3, 2> tilt = Eigen::Matrix<double, 3, 2>::Zero();
};

/// The local map: for each voxel the mean and the covariance of the points seen in it, hence a
/// plane where they are flat. After Yuan et al., "Efficient and Probabilistic Adaptive Voxel
/// Mapping for Accurate Online LiDAR Odometry" (RA-L 2022, sec. III), on one level. Frame: `odom`.
/// Cost: a hash look-up a point.
class VoxelMap {
 public:
  explicit VoxelMap(const VoxelMapConfig& config);

  [[nodiscard]] std::size_t size() const { return voxels_.size(); }
  [[nodiscard]] double voxel_m() const { return config_.voxel_m; }

  /// Calls see(mean of the points seen in it) for each voxel.
  template <class See>
  void each_voxel(See see) const {
    for (const Voxel& voxel : voxels_)
      see(voxel.corner + voxel.sum.cast<double>() / std::max(voxel.count, 1));
  }

  void clear();

  /// Adds finite points, given in `odom`.
  void insert(std::span<const Eigen::Vector3d> points, Time stamp);

  /// Drops what is too far from the sensor or too old, and beyond the ceiling what was not seen for
  /// longest.
  void prune(const Eigen::Vector3d& centre, Time now);

  /// The plane of the point's own voxel; when `wide`, else the one with the nearest mean in the 26
  /// voxels around. Planes carried on beyond their voxel hold the scan back: new ground lies ahead
  /// of what was seen, always on the same side.
  [[nodiscard]] std::optional<Plane> nearest_plane(const Eigen::Vector3d& point, bool wide);

 private:
  enum class Shape : std::uint8_t { unknown, plane, other };
  struct Voxel {
    VoxelKey key = 0;
    Time first_seen = 0, last_seen = 0;
    Eigen::Vector3d corner =
        Eigen::Vector3d::Zero();  // sums are relative to it: small numbers, exact in float
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    Eigen::Matrix3f products = Eigen::Matrix3f::Zero();
    int count = 0;
    Shape shape = Shape::unknown;
    float variance = 0;
    Eigen::Vector3f mean = Eigen::Vector3f::Zero();
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();
    Eigen::Matrix<float, 3, 2> tilt = Eigen::Matrix<float, 3, 2>::Zero();
  };

  void fit(Voxel& voxel) const;
  [[nodiscard]] Voxel* plane_at(const Eigen::Vector3i& cell);
  [[nodiscard]] Time oldest_to_keep() const;

  VoxelMapConfig config_;
  VoxelIndex index_;
  std::vector<Voxel> voxels_;
  mutable std::vector<Time> ages_;
};

}  // namespace saker::odometry
