#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "saker/lidar/rings.h"
#include "saker/lidar/scan.h"

namespace saker::segmentation {

/// A scan as the network sees it: rows (beams, row 0 the highest) × columns (azimuth, falling, so
/// that it reads as a picture seen from the sensor), the nearest point in each pixel.
///
/// An organised scan keeps its own pixels; more than 80 rows or 1024 columns are halved until they
/// fit. An unorganised scan gets its rows from lidar/rings.h, so that they follow the beams however
/// unevenly these lie, and its columns from the azimuth: 1024, or 512 where neighbours in a ring
/// are farther apart than 0.5°.
struct RangeImage {
  int rows = 0;
  int columns = 0;
  std::vector<Eigen::Vector3f> points;  ///< row-major, lidar frame; NaN where nothing returned
  std::vector<float> range;             ///< of `points`, m; 0 where nothing returned
  std::vector<std::int32_t> pixel;      ///< of each point of the scan; −1 where it is not finite
  std::vector<std::int32_t> point;      ///< of the scan, that is shown in each pixel; −1: none

  [[nodiscard]] std::size_t size() const { return points.size(); }
  [[nodiscard]] bool valid(std::size_t i) const { return range[i] > 0; }
};

inline constexpr int kMaxRows = 80;  // 64, and what unfolding may find too many
inline constexpr int kMaxColumns = 1024;

using lidar::kMinRange;

/// Writes into `image`, whose memory is used again from scan to scan.
void project(const lidar::Scan& scan, RangeImage& image);

}  // namespace saker::segmentation
