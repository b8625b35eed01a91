#include "saker/lidar/elevation_bands.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

namespace saker::lidar {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr float kSlice = 0.0005F;    // rad (0.03°): a third of the finest beam spacing there is
constexpr int kStepsACell = 4;       // firings of a beam in a cell of azimuth
constexpr int kMostACell = 5;        // one more, where the firings fall unluckily
constexpr float kPriceShare = 0.1F;  // of the points of a whole ring: what a band more costs
constexpr float kDearest = 0.6F;     // the same: a band that costs more is never worth its length
constexpr std::size_t kSampled = 25000;  // points that the search looks at
constexpr float kSampledArc = 0.2F;      // rad: points are taken in whole arcs of azimuth

/// Points by slices of elevation from the highest down; slices without points are left out.
struct Slices {
  std::vector<float> top;                         ///< elevation of the upper edge of each slice
  std::vector<std::vector<std::uint16_t>> cells;  ///< azimuth cell of each point in it
  int cell_count = 1;
  float ring_points = 1;  ///< of a whole ring, as far as it was sampled
};

Slices slice(const std::vector<float>& azimuth, const std::vector<float>& elevation, float step) {
  const auto arcs = static_cast<int>(2 * kPi / kSampledArc) + 1;
  const auto every =
      std::clamp(static_cast<int>(azimuth.size() / kSampled), 1, std::max(1, arcs / 4));
  const float cell = step * kStepsACell;
  Slices slices;
  slices.cell_count = std::max(1, static_cast<int>(2 * kPi / cell) + 1);
  slices.ring_points = 2 * kPi / step / static_cast<float>(every);
  const auto count = static_cast<std::size_t>(kPi / kSlice) + 1;
  std::vector<std::vector<std::uint16_t>> all(count);
  for (std::size_t i = 0; i < azimuth.size(); ++i) {
    const float turn = azimuth[i] + kPi;
    if (static_cast<int>(turn / kSampledArc) % every != 0) continue;
    const auto row = static_cast<std::size_t>((kPi / 2 - elevation[i]) / kSlice);
    all[std::min(row, count - 1)].push_back(static_cast<std::uint16_t>(
        std::clamp(static_cast<int>(turn / cell), 0, slices.cell_count - 1)));
  }
  for (std::size_t k = 0; k < count; ++k) {
    if (all[k].empty()) continue;
    slices.top.push_back(kPi / 2 - static_cast<float>(k) * kSlice);
    slices.cells.push_back(std::move(all[k]));
  }
  return slices;
}

/// The cheapest cut: for each slice the first slice of the band that ends with it.
std::vector<std::size_t> cut(const Slices& slices) {
  const std::size_t n = slices.cells.size();
  const float price = kPriceShare * slices.ring_points, dearest = kDearest * slices.ring_points;
  std::vector<float> cost(n + 1, std::numeric_limits<float>::infinity());
  std::vector<std::size_t> first(n + 1, 0);
  std::vector<std::uint16_t> held(static_cast<std::size_t>(slices.cell_count));
  cost[0] = 0;
  for (std::size_t begin = 0; begin < n; ++begin) {
    std::fill(held.begin(), held.end(), std::uint16_t{0});
    float over = 0;
    for (std::size_t end = begin; end < n && over < dearest; ++end) {
      for (const std::uint16_t c : slices.cells[end]) over += ++held[c] > kMostACell ? 1.0F : 0.0F;
      // A cut belongs where there are few points: equal costs are told apart by them.
      const float edge = 0.01F * static_cast<float>(slices.cells[end].size());
      const float total = cost[begin] + price + over + edge;
      if (total < cost[end + 1]) cost[end + 1] = total, first[end + 1] = begin;
    }
  }
  return first;
}

float lower_quartile(std::vector<float>& values) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 4);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// Lower quartile of the gaps of azimuth within one slice; 0 where it holds too few points.
float step_within(std::vector<float>& azimuth) {
  constexpr std::size_t kEnough = 60;
  constexpr float kRepeated = 3e-4F;  // rad: second returns of one firing
  if (azimuth.size() < kEnough) return 0;
  std::sort(azimuth.begin(), azimuth.end());
  std::vector<float> gaps;
  for (std::size_t i = 1; i < azimuth.size(); ++i) {
    const float gap = azimuth[i] - azimuth[i - 1];
    if (gap > kRepeated) gaps.push_back(gap);
  }
  return gaps.size() < kEnough / 2 ? 0 : lower_quartile(gaps);
}

}  // namespace

int ElevationBands::of(float elevation) const {
  const auto band = std::partition_point(lower_edge.begin(), lower_edge.end(),
                                         [&](float edge) { return edge > elevation; });
  return std::min(static_cast<int>(band - lower_edge.begin()), count() - 1);
}

ElevationBands find_elevation_bands(const std::vector<float>& azimuth,
                                    const std::vector<float>& elevation, float azimuth_step,
                                    int most) {
  const Slices slices = slice(azimuth, elevation, azimuth_step);
  const std::vector<std::size_t> first = cut(slices);
  ElevationBands bands;
  for (std::size_t end = slices.cells.size(); end > 0; end = first[end]) {
    const float below = end == slices.cells.size()
                            ? -std::numeric_limits<float>::infinity()
                            : 0.5F * (slices.top[end - 1] - kSlice + slices.top[end]);
    bands.lower_edge.push_back(below);
  }
  std::reverse(bands.lower_edge.begin(), bands.lower_edge.end());
  while (bands.count() > most) {  // pairs become one, from the top
    std::vector<float> merged;
    for (std::size_t i = 1; i < bands.lower_edge.size(); i += 2)
      merged.push_back(bands.lower_edge[i]);
    if (bands.lower_edge.size() % 2 == 1) merged.push_back(bands.lower_edge.back());
    bands.lower_edge = std::move(merged);
  }
  return bands;
}

float find_azimuth_step(const std::vector<float>& azimuth, const std::vector<float>& elevation) {
  constexpr std::size_t kFullest = 24;
  std::vector<std::vector<float>> slices(static_cast<std::size_t>(kPi / kSlice) + 1);
  for (std::size_t i = 0; i < azimuth.size(); ++i) {
    const auto row = static_cast<std::size_t>((kPi / 2 - elevation[i]) / kSlice);
    slices[std::min(row, slices.size() - 1)].push_back(azimuth[i]);
  }
  std::sort(slices.begin(), slices.end(),
            [](const auto& a, const auto& b) { return a.size() > b.size(); });
  std::vector<float> steps;
  for (std::size_t k = 0; k < std::min(kFullest, slices.size()); ++k) {
    const float step = step_within(slices[k]);
    if (step > 0) steps.push_back(step);
  }
  if (steps.empty()) return 0;
  std::sort(steps.begin(), steps.end());
  return steps[steps.size() / 2];
}

}  // namespace saker::lidar
