#include "saker/detection/clusters.h"

#include <algorithm>
#include <cmath>

namespace saker::detection {
namespace {

constexpr int kMostSquares = 4096;  // along an edge of the grid; what is outside falls on its rim
constexpr int kEmpty = -1;

}  // namespace

std::vector<std::vector<int>> Clusters::find(std::span<const Eigen::Vector2f> points,
                                             const ClusterConfig& config) {
  if (points.empty()) return {};
  Eigen::Vector2f low = points[0];
  Eigen::Vector2f high = points[0];
  for (const Eigen::Vector2f& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const float square = static_cast<float>(config.square_m);
  const Eigen::Array2i most = Eigen::Array2i::Constant(kMostSquares);
  const Eigen::Array2i size = (((high - low) / square).array().cast<int>() + 1).min(most);
  const std::size_t squares = static_cast<std::size_t>(size.x()) * size.y();
  if (grid_.size() < squares) grid_.resize(squares, kEmpty);
  samples_.clear();
  cell_of_sample_.clear();
  sample_of_point_.clear();
  for (const Eigen::Vector2f& p : points) {
    const Eigen::Array2i at = ((p - low) / square).array().cast<int>().min(size - 1);
    const std::size_t cell = static_cast<std::size_t>(at.y()) * size.x() + at.x();
    int& sample = grid_[cell];
    if (sample == kEmpty) {
      sample = static_cast<int>(samples_.size());
      samples_.push_back({p, 0});
      cell_of_sample_.push_back(cell);
    }
    samples_[sample].weight += 1;
    sample_of_point_.push_back(sample);
  }
  for (const std::size_t cell : cell_of_sample_) grid_[cell] = kEmpty;
  const std::vector<int> cluster = dbscan(samples_, config.reach_m, config.least_points);
  const int count = 1 + *std::max_element(cluster.begin(), cluster.end());
  std::vector<std::vector<int>> clusters(std::max(count, 0));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const int c = cluster[sample_of_point_[i]];
    if (c != kNoise) clusters[c].push_back(static_cast<int>(i));
  }
  return clusters;
}

}  // namespace saker::detection
