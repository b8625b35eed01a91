#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "saker/core/config.h"
#include "saker/detection/dbscan.h"

namespace saker::detection {

struct ClusterConfig {
  double square_m = 0.1;
  double reach_m = 0.5;
  double least_points = 6;

  ClusterConfig() = default;
  ClusterConfig(double square, double reach, double least)
      : square_m(square), reach_m(reach), least_points(least) {}

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("square_m", square_m, {0.02, 1}, "m",
            "points are thinned to squares of this edge before they are clustered");
    v.field("reach_m", reach_m, {0.05, 5}, "m",
            "DBSCAN's distance between neighbours: below the gap between parked vehicles, above "
            "the spacing of beams on one");
    v.field("least_points", least_points, {1, 1000}, "points",
            "DBSCAN's weight of a core sample: points within reach, all scans together");
  }
};

/// Clusters points by their places in the x-y plane: thins them to squares, each weighing its
/// points, then DBSCAN. Keeps its memory between calls.
class Clusters {
 public:
  /// \return the indices of each cluster's points, ascending; noise is left out.
  [[nodiscard]] std::vector<std::vector<int>> find(std::span<const Eigen::Vector2f> points,
                                                   const ClusterConfig& config);

 private:
  std::vector<int> grid_;  ///< the sample of each square; all empty between calls
  std::vector<std::size_t> cell_of_sample_;
  std::vector<int> sample_of_point_;
  std::vector<WeightedSample> samples_;
};

}  // namespace saker::detection
