#include "detection/interval.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace saker::detection {

Eigen::Matrix2d of_centre_and_size(const Eigen::Matrix2d& of_edges) {
  Eigen::Matrix2d to_centre_size;
  to_centre_size << 0.5, 0.5, -1, 1;
  return to_centre_size * of_edges * to_centre_size.transpose();
}

Interval fuse_edges(const Edge& low, const Edge& high, const SizePrior& prior, double seen_sd) {
  Eigen::Matrix2d information =
      Eigen::Vector2d(std::pow(low.sd, -2), std::pow(high.sd, -2)).asDiagonal();
  Eigen::Vector2d weighted = information * Eigen::Vector2d(low.position, high.position);
  if (std::max(low.sd, high.sd) > seen_sd) {
    const Eigen::Vector2d difference(-1, 1);
    const double weight = std::pow(prior.sd, -2);
    information += weight * difference * difference.transpose();
    weighted += weight * prior.mean * difference;
  }
  const Eigen::Matrix2d covariance = information.inverse();
  const Eigen::Vector2d edges = covariance * weighted;
  return {edges.x(), edges.y(), of_centre_and_size(covariance)};
}

}  // namespace saker::detection
