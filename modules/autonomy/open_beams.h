#pragma once

#include <Eigen/Core>
#include <vector>

#include "saker/core/se3.h"
#include "saker/lidar/ray_table.h"
#include "saker/lidar/scan.h"
#include "saker/lidar/sensor_info.h"

namespace saker::autonomy {

/// Beams that nothing answers: the sky, and ground that is met too flatly. Without them all that is
/// known to be free lies under the horizon, and a vehicle that flies only where it has seen sinks.
///
/// Such a beam becomes a point `kOpen_m` away, farther than any return: it clears, and is used for
/// nothing else. Taken for open is a pixel that has no return, as its eight neighbours, in a column
/// that came (one with a return): single drop-outs and lost packets are not open. Nor is one that
/// leads down to the ground: what swallows it is there, polished black paint or water. Glass at
/// eye level is missed: it is missed by the other beams too.
class OpenBeams {
 public:
  static constexpr float kOpen_m = 200;

  explicit OpenBeams(const lidar::SensorInfo& info);

  /// The scan's points, with those of open beams. An unorganised scan has none.
  [[nodiscard]] std::vector<Eigen::Vector3f> added_to(const lidar::Scan& scan);

  /// Takes out (NaN) those that lead down to the ground, which is about as high as z = 0 of `odom`,
  /// where the vehicle took off.
  /// \param points  of `added_to`, deskewed: lidar frame, m
  static void drop_steep(std::vector<Eigen::Vector3f>& points, const SE3& T_odom_lidar);

  /// Whether a point stands for such a beam.
  [[nodiscard]] static bool is_open(const Eigen::Vector3f& point) {
    return point.norm() > kOpen_m - kMostDeskewing_m;
  }

 private:
  static constexpr float kMostDeskewing_m = 5;  ///< by which deskewing moves such a point, at most
  /// Below the horizon: flatter ones meet level ground too flatly for an answer.
  static constexpr double kFlat_deg = 5;
  /// Along a beam: farther away not even bright ground answers.
  static constexpr double kGroundAnswers_m = 60;

  /// The column as sent, of a destaggered one.
  [[nodiscard]] int sent_column(int row, int column) const;
  [[nodiscard]] bool silent_around(const lidar::Scan& scan, int row, int column) const;
  void find_columns(const lidar::Scan& scan);

  lidar::RayTable rays_;
  std::vector<int> shift_;
  int rows_;
  int columns_;
  std::vector<bool> came_;  // columns as sent
};

}  // namespace saker::autonomy
