#pragma once

#include <cmath>
#include <span>
#include <vector>

namespace saker::tools {

/// How a figure changes with time.
struct Trend {
  double level = NAN;            ///< the median of the figure
  double slope = NAN;            ///< per unit of time
  double low = NAN, high = NAN;  ///< 95 % interval of the slope; NaN below kLeastSamples samples
  int samples = 0;

  /// Per cent of the level per unit of time.
  [[nodiscard]] double in_percent(double slope_value) const { return 100 * slope_value / level; }
};

inline constexpr int kLeastSamples = 4;

/// The median of the slopes between all pairs, which a third of outliers does not move, and its
/// interval by Kendall's statistic, ties counted: a figure that never changes has slope 0 for sure.
/// Pairs at one time are left out. Cost: quadratic.
/// Source: Sen, "Estimates of the regression coefficient based on Kendall's tau", 1968, section 4.
[[nodiscard]] Trend trend_of(std::span<const double> times, std::span<const double> values);

/// At most `most` samples, medians of neighbours: what is sampled often is alike from sample to
/// sample, and an interval that takes each for news is too narrow.
struct Series {
  std::vector<double> times, values;
};
[[nodiscard]] Series thinned(const Series& series, std::size_t most);

/// The series without its first share: caches fill, pools grow.
[[nodiscard]] Series settled(const Series& series, double share);

/// Whether the floor rises: the least of the second half is above the least of the first. What is
/// taken and given back leaves the floor where it is. False below kLeastSamples samples.
[[nodiscard]] bool floor_rises(std::span<const double> values);

}  // namespace saker::tools
