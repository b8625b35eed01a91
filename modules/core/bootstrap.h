#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <span>

namespace saker::core {

/// A figure of a sample, and between what the true one lies.
struct Interval {
  double estimate = NAN;
  double low = NAN, high = NAN;

  [[nodiscard]] bool excludes(double value) const { return value < low || value > high; }
};

struct BootstrapOptions {
  int resamples = 4000;  ///< the 2.5 % quantile stands on a hundred of them
  double confidence = 0.95;
  std::uint64_t seed = 1;
};

/// A figure of some of the sample's units, by their indices, which may come more than once.
using Statistic = std::function<double(std::span<const int> units)>;

/// Percentile bootstrap (Efron, "Bootstrap methods", Annals of Statistics 1979): the statistic over
/// units drawn with replacement, again and again. A paired comparison takes both sides' figures
/// from the same units. Low and high are NaN below two units, or where a resample has no finite
/// figure. A function of its arguments.
[[nodiscard]] Interval bootstrap(int units, const Statistic& statistic,
                                 const BootstrapOptions& options = {});

}  // namespace saker::core
