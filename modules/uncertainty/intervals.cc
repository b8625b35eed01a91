#include "saker/uncertainty/intervals.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace saker::uncertainty {

double Intervals::range_centre(int range) const {
  const auto i = static_cast<std::size_t>(range);
  return 0.5 * (range_edges[i] + range_edges[i + 1]);
}

double Intervals::sector_centre(int sector) const {
  return (sector + 0.5) * std::numbers::pi / sectors;
}

int Intervals::of(const View& view) const {
  const auto inner_begin = range_edges.begin() + 1, inner_end = range_edges.end() - 1;
  const auto range =
      static_cast<int>(std::upper_bound(inner_begin, inner_end, view.range) - inner_begin);
  const int sector = static_cast<int>(std::abs(view.angle) / std::numbers::pi * sectors);
  return index(range, std::min(sector, sectors - 1));
}

}  // namespace saker::uncertainty
