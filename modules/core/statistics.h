#pragma once

#include <span>

/// Statistics of samples. An empty sample gives NaN.
namespace saker::core {

[[nodiscard]] double mean(std::span<const double> values);
[[nodiscard]] double standard_deviation(
    std::span<const double> values);  ///< over n − 1; NaN below two
[[nodiscard]] double mean_absolute(std::span<const double> values);

/// Linear between the order statistics: percentile(v, 0.5) is the median. \param ratio 0 … 1
[[nodiscard]] double percentile(std::span<const double> values, double ratio);
[[nodiscard]] double median(std::span<const double> values);

/// y = slope · x + offset by least squares; NaN where all x are equal.
struct Line {
  double slope, offset;
};
[[nodiscard]] Line fit_line(std::span<const double> x, std::span<const double> y);

}  // namespace saker::core
