#include "saker/segmentation/beam_spacing.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace saker::segmentation {
namespace {

constexpr int kSampled = 8;            // every so many columns tell a row's elevation
constexpr int kMostColumns = 32;       // that a baseline spans, whatever the range
constexpr int kMostRows = 24;          // the same
constexpr float kSmallest = 1e-4F;     // rad between beams
constexpr float kSmoothed = 0.1F;      // m on either side
constexpr float kSameSurface = 0.15F;  // m, three sd of a noisy sensor's range

/// Mean elevation of a row; that of the row above it where it is empty.
float mean_elevation(const RangeImage& image, int row, float above) {
  const std::size_t begin = static_cast<std::size_t>(row) * image.columns;
  float sum = 0;
  int count = 0;
  for (std::size_t i = begin; i < begin + image.columns; i += kSampled) {
    if (!image.valid(i)) continue;
    sum += std::asin(std::clamp(image.points[i].z() / image.range[i], -1.0F, 1.0F));
    ++count;
  }
  return count > 0 ? sum / static_cast<float>(count) : above;
}

float smoothed(const RangeImage& image, std::size_t begin, int column, int half) {
  const float range = image.range[begin + column];
  float sum = 0;
  int count = 0;
  for (int c = column - half; c <= column + half; ++c) {
    const int wrapped = c < 0 ? c + image.columns : c >= image.columns ? c - image.columns : c;
    const float other = image.range[begin + wrapped];
    if (std::abs(other - range) > kSameSurface) continue;
    sum += other;
    ++count;
  }
  return sum / static_cast<float>(count);
}

}  // namespace

void BeamSpacing::measure(const RangeImage& image) {
  column_pitch_ = 2 * std::numbers::pi_v<float> / static_cast<float>(std::max(image.columns, 1));
  elevation_.resize(static_cast<std::size_t>(image.rows));
  float above = std::numbers::pi_v<float> / 2;
  for (int row = 0; row < image.rows; ++row)
    elevation_[row] = above = mean_elevation(image, row, above);
  pitch_.assign(elevation_.size(), kSmallest);
  for (std::size_t row = 0; row + 1 < elevation_.size(); ++row)
    pitch_[row] = std::max(elevation_[row] - elevation_[row + 1], kSmallest);
  if (pitch_.size() > 1) pitch_.back() = pitch_[pitch_.size() - 2];
}

int BeamSpacing::columns(float range, float metres) const {
  const float most = std::min(static_cast<float>(kMostColumns), metres / (range * column_pitch_));
  return std::max(1, static_cast<int>(std::ceil(most)));
}

int BeamSpacing::row_below(int row, float range, float metres) const {
  const int last = static_cast<int>(elevation_.size()) - 1;
  const int most = std::min(last, row + kMostRows);
  int other = std::min(row + 1, last);
  while (other < most && (elevation_[row] - elevation_[other]) * range < metres) ++other;
  return other;
}

int BeamSpacing::row_above(int row, float range, float metres) const {
  const int most = std::max(0, row - kMostRows);
  int other = std::max(row - 1, 0);
  while (other > most && (elevation_[other] - elevation_[row]) * range < metres) --other;
  return other;
}

void smooth_ranges(const RangeImage& image, const BeamSpacing& spacing, RangeImage& smooth) {
  smooth.rows = image.rows;
  smooth.columns = image.columns;
  smooth.points = image.points;
  smooth.range = image.range;
  for (int row = 0; row < image.rows; ++row) {
    const std::size_t begin = static_cast<std::size_t>(row) * image.columns;
    for (int column = 0; column < image.columns; ++column) {
      const std::size_t i = begin + column;
      if (!image.valid(i)) continue;
      const int half = std::min(spacing.columns(image.range[i], kSmoothed), image.columns) - 1;
      if (half < 1) continue;
      smooth.range[i] = smoothed(image, begin, column, half);
      smooth.points[i] *= smooth.range[i] / image.range[i];
    }
  }
}

}  // namespace saker::segmentation
