#pragma once

#include <Eigen/Core>
#include <vector>

namespace saker::lidar {

/// x, y, z (m), roll and pitch (rad) of a sensor in the recording's frame; yaw is 0.
using SensorPose = Eigen::Matrix<float, 5, 1>;

/// The sensor's z axis in the recording's frame: R = Ry(pitch) Rx(roll).
[[nodiscard]] Eigen::Vector3f sensor_axis(const SensorPose& pose);

/// How sharply the elevations of a scan, seen from a pose, gather at few values (beams).
///
/// Sines of elevation are counted in bins. In each tile of 24 bins, the pairs of points that share
/// a bin are compared with the pairs that an even distribution over the tile would make. The
/// sharpness is the mean logarithm of that ratio: 0 where no beams can be seen.
class BeamSharpness {
 public:
  /// \param points  in the recording's frame; 24,000 of the finite ones are used
  explicit BeamSharpness(const std::vector<Eigen::Vector3f>& points);

  /// True where the points are too few to tell anything.
  [[nodiscard]] bool empty() const { return all_.sector.empty(); }

  /// Over a quarter of the points, about a pose with its tilt.
  [[nodiscard]] float whole(const SensorPose& pose, float bin) const;

  /// Within sectors of azimuth. A tilt shifts all elevations of a sector nearly alike, so that it
  /// need not be known.
  [[nodiscard]] float by_sector(const SensorPose& pose, float bin) const;

  /// Share of the points in bins that hold less than an even distribution would put there.
  [[nodiscard]] float share_between_beams(const SensorPose& pose, float bin) const;

 private:
  struct Points {
    Eigen::ArrayXf x, y, z;
    std::vector<Eigen::Index> sector;  ///< where each begins, and the end
  };
  [[nodiscard]] static float sharpness(const Points& points, const SensorPose& pose, float bin);

  Points all_;  ///< by sector
  Points few_;  ///< in one sector
};

}  // namespace saker::lidar
