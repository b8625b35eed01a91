#include "saker/core/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace saker::core {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

template <class Function>
double mean_of(std::span<const double> values, Function function) {
  double sum = 0;
  for (const double v : values) sum += function(v);
  return values.empty() ? kNaN : sum / static_cast<double>(values.size());
}

}  // namespace

double mean(std::span<const double> values) {
  return mean_of(values, [](double v) { return v; });
}

double standard_deviation(std::span<const double> values) {
  if (values.size() < 2) return kNaN;
  const double center = mean(values);
  const double variance = mean_of(values, [&](double v) { return (v - center) * (v - center); });
  const auto n = static_cast<double>(values.size());
  return std::sqrt(variance * n / (n - 1));
}

double mean_absolute(std::span<const double> values) {
  return mean_of(values, [](double v) { return std::abs(v); });
}

double percentile(std::span<const double> values, double ratio) {
  if (values.empty()) return kNaN;
  std::vector<double> all(values.begin(), values.end());
  const double place = std::clamp(ratio, 0.0, 1.0) * static_cast<double>(all.size() - 1);
  const auto low = all.begin() + static_cast<std::ptrdiff_t>(place);
  std::nth_element(all.begin(), low, all.end());
  const double next = low + 1 == all.end() ? *low : *std::min_element(low + 1, all.end());
  return *low + (place - std::floor(place)) * (next - *low);
}

double median(std::span<const double> values) { return percentile(values, 0.5); }

Line fit_line(std::span<const double> x, std::span<const double> y) {
  const double mean_x = mean(x), mean_y = mean(y);
  double xx = 0, xy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mean_x) * (x[i] - mean_x);
    xy += (x[i] - mean_x) * (y[i] - mean_y);
  }
  if (!(xx > 0)) return {kNaN, kNaN};
  return {xy / xx, mean_y - xy / xx * mean_x};
}

}  // namespace saker::core
