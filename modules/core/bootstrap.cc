#include "saker/core/bootstrap.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "saker/core/rng.h"
#include "saker/core/statistics.h"

namespace saker::core {

Interval bootstrap(int units, const Statistic& statistic, const BootstrapOptions& options) {
  std::vector<int> drawn(static_cast<std::size_t>(std::max(units, 0)));
  std::iota(drawn.begin(), drawn.end(), 0);
  Interval interval{.estimate = statistic(drawn)};
  if (units < 2) return interval;
  Rng rng(options.seed);
  std::vector<double> figures;
  for (int i = 0; i < options.resamples; ++i) {
    for (int& unit : drawn) unit = rng.index(units);
    figures.push_back(statistic(drawn));
    if (!std::isfinite(figures.back())) return interval;
  }
  std::sort(figures.begin(), figures.end());
  const double tail = (1 - options.confidence) / 2;
  interval.low = percentile(figures, tail);
  interval.high = percentile(figures, 1 - tail);
  return interval;
}

}  // namespace saker::core
