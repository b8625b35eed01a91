#include "tools/saker/soak/trend.h"

#include <algorithm>
#include <map>

#include "saker/core/statistics.h"

namespace saker::tools {
namespace {

constexpr double kNormal95 = 1.959964;

/// Of Kendall's S where nothing but chance orders the values.
double variance_of_s(std::span<const double> values) {
  const auto term = [](double n) { return n * (n - 1) * (2 * n + 5); };
  std::map<double, int> equal;
  for (const double value : values) ++equal[value];
  double sum = term(static_cast<double>(values.size()));
  for (const auto& [value, count] : equal) sum -= term(count);
  return sum / 18;
}

std::vector<double> slopes_of(std::span<const double> times, std::span<const double> values) {
  std::vector<double> slopes;
  for (std::size_t i = 0; i < times.size(); ++i) {
    for (std::size_t j = i + 1; j < times.size(); ++j) {
      if (times[i] != times[j]) {
        slopes.push_back((values[j] - values[i]) / (times[j] - times[i]));
      }
    }
  }
  std::ranges::sort(slopes);
  return slopes;
}

double at_rank(const std::vector<double>& sorted, double rank) {
  const double last = static_cast<double>(sorted.size()) - 1;
  return sorted[static_cast<std::size_t>(std::clamp(rank, 0.0, last))];
}

}  // namespace

Trend trend_of(std::span<const double> times, std::span<const double> values) {
  Trend trend{.level = core::median(values), .samples = static_cast<int>(values.size())};
  const std::vector<double> slopes = slopes_of(times, values);
  if (slopes.empty()) return trend;
  trend.slope = core::median(slopes);
  if (trend.samples < kLeastSamples) return trend;
  const auto count = static_cast<double>(slopes.size());
  const double reach = kNormal95 * std::sqrt(variance_of_s(values));
  trend.low = std::min(at_rank(slopes, std::floor((count - reach) / 2) - 1), trend.slope);
  trend.high = std::max(at_rank(slopes, std::ceil((count + reach) / 2)), trend.slope);
  return trend;
}

Series thinned(const Series& series, std::size_t most) {
  const std::size_t count = series.times.size();
  if (count <= most) return series;
  Series thin;
  const auto begin_of = [&](std::size_t block) {
    return static_cast<std::ptrdiff_t>(block * count / most);
  };
  for (std::size_t block = 0; block < most; ++block) {
    const auto from = begin_of(block), to = begin_of(block + 1);
    const auto median_of = [&](const std::vector<double>& all) {
      return core::median(std::vector<double>(all.begin() + from, all.begin() + to));
    };
    thin.times.push_back(median_of(series.times));
    thin.values.push_back(median_of(series.values));
  }
  return thin;
}

Series settled(const Series& series, double share) {
  if (series.times.empty()) return {};
  const double from = series.times.front() + share * (series.times.back() - series.times.front());
  Series rest;
  for (std::size_t i = 0; i < series.times.size(); ++i) {
    if (series.times[i] < from) continue;
    rest.times.push_back(series.times[i]);
    rest.values.push_back(series.values[i]);
  }
  return rest;
}

bool floor_rises(std::span<const double> values) {
  if (values.size() < kLeastSamples) return false;
  const std::size_t half = values.size() / 2;
  return std::ranges::min(values.subspan(half)) > std::ranges::min(values.first(half));
}

}  // namespace saker::tools
