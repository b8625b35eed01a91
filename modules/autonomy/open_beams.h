#pragma once

#include <Eigen/Core>
#include <vector>

#include "lidar/ray_table.h"
#include "lidar/scan.h"
#include "lidar/sensor_info.h"

namespace saker::autonomy {

/// Beams that nothing answers: the sky, and ground that is met too flatly. Without them all that is
/// known to be free lies under the horizon, and a vehicle that flies only where it has seen sinks.
///
/// Such a beam becomes a point `kOpen_m` away, farther than any return: it clears, and is used for
/// nothing else. Taken for open is a pixel that has no return, as its eight neighbours, in a column
/// that came (one with a return): single drop-outs and lost packets are not open. What is nearer
/// than 15 m and swallows a whole patch of beams (a mirror, black glass) is missed: it is missed by
/// the other beams too.
class OpenBeams {
 public:
  static constexpr float kOpen_m = 200;

  explicit OpenBeams(const lidar::SensorInfo& info);

  /// The scan's points, with those of open beams. An unorganised scan has none.
  [[nodiscard]] std::vector<Eigen::Vector3f> added_to(const lidar::Scan& scan);

 private:
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
