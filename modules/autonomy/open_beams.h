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
/// Such a beam becomes a point farther away than any return (occupancy/open_beam.h): it clears, and
/// is used for nothing else. Taken for open is a pixel that has no return, as its eight neighbours,
/// in a column that came (one with a return): single drop-outs and lost packets are not open. Nor
/// is one that leads down to the ground: what swallows it is there, polished black paint or water.
///
/// Glass swallows a beam at any range, but a pane ends at a frame, which answers: float glass is
/// sold 3.21 m by 6 m, longer only to order. Around a beam nothing answers over the angles α left
/// and β right, so a pane at range r would be at least r (sin α + sin β) wide, and likewise high;
/// where that is more than is sold nothing but air is there. From there on the beam clears, nearer
/// it tells nothing: between two trees from some 7 m on, in the open sky at once. A facade whose
/// frames are thinner than beams are apart is not known. Black paint answers within the range that
/// is mapped (occupancy.range_m 15 m; an OS0 is rated 35 m at 10 %: 19 m at 3 %).
class OpenBeams {
 public:
  explicit OpenBeams(const lidar::SensorInfo& info);

  /// The scan's points, with those of open beams. An unorganised scan has none.
  [[nodiscard]] std::vector<Eigen::Vector3f> added_to(const lidar::Scan& scan);

  /// Takes out (NaN) those that lead down to the ground, which is about as high as z = 0 of `odom`,
  /// where the vehicle took off.
  /// \param points  of `added_to`, deskewed: lidar frame, m
  static void drop_steep(std::vector<Eigen::Vector3f>& points, const SE3& T_odom_lidar);

 private:
  static constexpr float kLongest_m = 6, kNarrowest_m = 3.21F;  ///< of panes that are made
  static constexpr float kNoUse_m = 50;  ///< beyond what is mapped: it tells nothing
  /// Below the horizon: flatter ones meet level ground too flatly for an answer.
  static constexpr double kFlat_deg = 5;
  /// Along a beam: farther away not even bright ground answers.
  static constexpr double kGroundAnswers_m = 60;

  /// The column as sent, of a destaggered one.
  [[nodiscard]] int sent_column(int row, int column) const;
  /// Pixels to four sides that nothing answers either, as far as they follow on each other.
  struct Gap {
    int left = 0, right = 0, up = 0, down = 0;
  };

  [[nodiscard]] bool silent_around(int row, int column) const;
  void find_columns(const lidar::Scan& scan);
  void find_silent(const lidar::Scan& scan);
  void find_gaps();
  [[nodiscard]] float clears_from_m(int row, const Gap& gap) const;
  [[nodiscard]] std::size_t pixel(int row, int column) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }

  lidar::RayTable rays_;
  std::vector<int> shift_;
  int rows_;
  int columns_;
  std::vector<float> elevation_;  // rad, of each row
  std::vector<bool> came_;        // columns as sent
  std::vector<bool> silent_;      // pixels
  std::vector<Gap> gaps_;         // of each pixel
};

}  // namespace saker::autonomy
