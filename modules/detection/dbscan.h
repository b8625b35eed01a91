#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

/// DBSCAN in the plane: Ester et al., "A Density-Based Algorithm for Discovering Clusters", KDD
/// 1996.
///
/// Samples with weights, so that a thinned cloud clusters like the whole one. Neighbours are looked
/// up on a grid of edge `reach`, sorted: O(n log n) for bounded density. The result depends on the
/// order of the samples only where a border sample touches two clusters: the first one takes it.
namespace saker::detection {

struct WeightedSample {
  Eigen::Vector2f position;
  float weight = 1;
};

constexpr int kNoise = -1;

/// A core sample has at least `least_weight` within `reach`, itself included.
/// \return each sample's cluster, numbered from 0 in the order of their first core samples, or
/// kNoise.
[[nodiscard]] std::vector<int> dbscan(std::span<const WeightedSample> samples, double reach,
                                      double least_weight);

}  // namespace saker::detection
