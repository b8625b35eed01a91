#include "saker/detection/dbscan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace saker::detection {
namespace {

constexpr int kUnvisited = -2;

/// Samples sorted by cells of edge `reach`.
class SampleGrid {
 public:
  SampleGrid(std::span<const WeightedSample> samples, double reach)
      : samples_(samples), reach_(static_cast<float>(reach)), cell_of_(samples.size()) {
    entries_.reserve(samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const auto [column, row] = cell_at(samples[i].position);
      entries_.push_back({key(column, row), static_cast<int>(i)});
    }
    std::sort(entries_.begin(), entries_.end());
    for (std::size_t e = 0; e < entries_.size(); ++e) {
      const auto [cell, sample] = entries_[e];
      if (e == 0 || cell != entries_[e - 1].first) cells_.push_back(rows_about(cell));
      cell_of_[sample] = cells_.size() - 1;
    }
  }

  /// Indices within reach of sample i, itself included.
  void neighbours(int i, std::vector<int>& found) const {
    found.clear();
    const Eigen::Vector2f centre = samples_[i].position;
    for (const auto& [first, last] : cells_[cell_of_[i]]) {
      for (std::size_t e = first; e < last; ++e) {
        const int other = entries_[e].second;
        if ((samples_[other].position - centre).squaredNorm() <= reach_ * reach_) {
          found.push_back(other);
        }
      }
    }
  }

 private:
  using Entry = std::pair<std::int64_t, int>;
  /// Entries from … to in the three cells of each row about a cell: their keys are consecutive.
  using RowsAbout = std::array<std::pair<std::size_t, std::size_t>, 3>;
  static constexpr std::int64_t kRow = std::int64_t{1} << 32;

  [[nodiscard]] std::pair<std::int64_t, std::int64_t> cell_at(const Eigen::Vector2f& p) const {
    return {static_cast<std::int64_t>(std::floor(p.x() / reach_)),
            static_cast<std::int64_t>(std::floor(p.y() / reach_))};
  }
  static std::int64_t key(std::int64_t column, std::int64_t row) { return row * kRow + column; }

  [[nodiscard]] RowsAbout rows_about(std::int64_t cell) const {
    RowsAbout rows;
    for (int r = 0; r < 3; ++r) {
      const std::int64_t middle = cell + (r - 1) * kRow;
      rows[r] = {place_of(middle - 1), place_of(middle + 2)};
    }
    return rows;
  }
  [[nodiscard]] std::size_t place_of(std::int64_t cell) const {
    return static_cast<std::size_t>(std::ranges::lower_bound(entries_, Entry{cell, 0}) -
                                    entries_.begin());
  }

  std::span<const WeightedSample> samples_;
  float reach_;
  std::vector<Entry> entries_;
  std::vector<RowsAbout> cells_;
  std::vector<std::size_t> cell_of_;  ///< of each sample
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
