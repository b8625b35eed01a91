#include "saker/detection/dbscan.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace saker::detection {
namespace {

constexpr int kUnvisited = -2;

/// Samples sorted by cells of edge `reach`.
class SampleGrid {
 public:
  SampleGrid(std::span<const WeightedSample> samples, double reach)
      : samples_(samples), reach_(static_cast<float>(reach)) {
    entries_.reserve(samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const auto [column, row] = cell_of(samples[i].position);
      entries_.push_back({key(column, row), static_cast<int>(i)});
    }
    std::sort(entries_.begin(), entries_.end());
  }

  /// Indices within reach of sample i, itself included.
  void neighbours(int i, std::vector<int>& found) const {
    found.clear();
    const Eigen::Vector2f centre = samples_[i].position;
    const auto [column, row] = cell_of(centre);
    for (std::int64_t r = row - 1; r <= row + 1; ++r) {
      // The keys of a row's three cells are consecutive.
      const std::int64_t last = key(column + 1, r);
      for (auto e =
               std::lower_bound(entries_.begin(), entries_.end(), Entry{key(column - 1, r), 0});
           e != entries_.end() && e->first <= last; ++e) {
        if ((samples_[e->second].position - centre).squaredNorm() <= reach_ * reach_) {
          found.push_back(e->second);
        }
      }
    }
  }

 private:
  using Entry = std::pair<std::int64_t, int>;

  [[nodiscard]] std::pair<std::int64_t, std::int64_t> cell_of(const Eigen::Vector2f& p) const {
    return {static_cast<std::int64_t>(std::floor(p.x() / reach_)),
            static_cast<std::int64_t>(std::floor(p.y() / reach_))};
  }
  static std::int64_t key(std::int64_t column, std::int64_t row) {
    return row * (std::int64_t{1} << 32) + column;
  }

  std::span<const WeightedSample> samples_;
  float reach_;
  std::vector<Entry> entries_;
};

float weight_of(std::span<const WeightedSample> samples, const std::vector<int>& indices) {
  float weight = 0;
  for (const int i : indices) weight += samples[i].weight;
  return weight;
}

}  // namespace

std::vector<int> dbscan(std::span<const WeightedSample> samples, double reach,
                        double least_weight) {
  const SampleGrid grid(samples, reach);
  std::vector<int> cluster(samples.size(), kUnvisited);
  std::vector<int> found;
  std::vector<int> open;
  int clusters = 0;
  const auto is_core = [&](int i) {
    grid.neighbours(i, found);
    return weight_of(samples, found) >= least_weight;
  };
  for (int seed = 0; seed < static_cast<int>(samples.size()); ++seed) {
    if (cluster[seed] != kUnvisited) continue;
    if (!is_core(seed)) {
      cluster[seed] = kNoise;
      continue;
    }
    cluster[seed] = clusters;
    open.assign(1, seed);
    while (!open.empty()) {
      const int i = open.back();
      open.pop_back();
      if (!is_core(i)) continue;
      for (const int j : found) {
        if (cluster[j] == kUnvisited) open.push_back(j);
        if (cluster[j] < 0) cluster[j] = clusters;
      }
    }
    ++clusters;
  }
  return cluster;
}

}  // namespace saker::detection
