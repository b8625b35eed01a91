#pragma once

#include <Eigen/Core>

/// The extent of an object along one axis, from its two edges.
namespace saker::detection {

/// An edge as it was measured; a large sd says that it was not seen, only that the object reaches
/// at least so far.
struct Edge {
  double position = 0;
  double sd = 0;
};

struct SizePrior {
  double mean = 0;
  double sd = 0;
};

struct Interval {
  double low = 0;
  double high = 0;
  Eigen::Matrix2d covariance;  ///< of [centre, size]

  [[nodiscard]] double centre() const { return 0.5 * (low + high); }
  [[nodiscard]] double size() const { return high - low; }
};

/// The covariance of [centre, size] by that of [low, high].
[[nodiscard]] Eigen::Matrix2d of_centre_and_size(const Eigen::Matrix2d& of_edges);

/// The two edges and the Gaussian prior of their distance, fused by least squares: an edge that
/// was not seen moves until the size is likely, one that was seen stays. The prior counts only
/// where an edge was not seen (sd above `seen_sd`).
[[nodiscard]] Interval fuse_edges(const Edge& low, const Edge& high, const SizePrior& prior,
                                  double seen_sd);

}  // namespace saker::detection
