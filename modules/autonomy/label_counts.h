#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>

#include "saker/lidar/scan.h"

namespace saker::autonomy {

/// What the network made of a scan's finite points. Whole numbers: the order in which those of
/// several scans are added does not matter.
struct LabelCounts {
  std::int64_t points = 0;
  std::int64_t classified = 0;              ///< with another class than `other`
  std::int64_t probability_millionths = 0;  ///< sum of the labels' probabilities

  /// 0 where there are no points.
  [[nodiscard]] double classified_share() const {
    return points == 0 ? 0 : static_cast<double>(classified) / static_cast<double>(points);
  }
};

/// \param labels  one a point; of points beyond them nothing is counted
[[nodiscard]] LabelCounts counted(std::span<const Eigen::Vector3f> points,
                                  const lidar::Labels& labels);

}  // namespace saker::autonomy
