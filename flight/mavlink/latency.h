#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace saker::flight::mavlink {

/// How long something took, since the start: a histogram of quarter octaves from 1 µs to 16 s, so
/// that a quantile is at most 19 % too long. Nothing is allocated.
class LatencyHistogram {
 public:
  /// What is no number is not counted; what is beyond the bins counts into the last one.
  void add(double seconds) {
    if (!std::isfinite(seconds)) return;
    const double bin = std::ceil(kPerOctave * std::log2(std::max(seconds, kLeast) / kLeast));
    ++bins_[std::min(static_cast<std::size_t>(bin), bins_.size() - 1)];
    ++count_;
  }

  /// s, the upper end of the bin; NaN: nothing was counted. \param share  0 … 1
  [[nodiscard]] double quantile(double share) const {
    if (count_ == 0) return std::numeric_limits<double>::quiet_NaN();
    const auto wanted = std::max(1L, std::lround(std::ceil(share * static_cast<double>(count_))));
    long below = 0;
    std::size_t bin = 0;
    while (bin + 1 < bins_.size() && (below += bins_[bin]) < wanted) ++bin;
    return kLeast * std::exp2(static_cast<double>(bin) / kPerOctave);
  }

  [[nodiscard]] long count() const { return count_; }

 private:
  static constexpr double kLeast = 1e-6, kPerOctave = 4;

  std::array<long, 97> bins_{};
  long count_ = 0;
};

}  // namespace saker::flight::mavlink
