#include "saker/segmentation/features.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace saker::segmentation {
namespace {

constexpr int kReach = 3;         // pixels over which a neighbour is sought where one is missing
constexpr float kNothing = 2.0F;  // step to no return at all: sky

float step(float from, float to) {
  if (!(to > 0)) return kNothing;
  return std::clamp(std::asinh((to - from) / 0.3F) / 3, -kNothing, kNothing);
}

/// The first pixel with a return from `columns` to the right on, or i itself.
std::size_t right_of(const RangeImage& image, std::size_t i, std::size_t columns) {
  const std::size_t width = image.columns, begin = i / width * width;
  for (std::size_t d = columns; d < columns + kReach; ++d) {
    const std::size_t other = begin + (i - begin + d) % width;
    if (image.valid(other)) return other;
  }
  return i;
}

/// The first pixel with a return in the column from a row on, or i itself.
std::size_t below(const RangeImage& image, std::size_t i, int row) {
  const std::size_t column = i % static_cast<std::size_t>(image.columns);
  for (int r = row; r < std::min(row + kReach, image.rows); ++r) {
    const std::size_t other = static_cast<std::size_t>(r) * image.columns + column;
    if (other != i && image.valid(other)) return other;
  }
  return i;
}

float slope_between(const Eigen::Vector3f& low, const Eigen::Vector3f& high,
                    const Eigen::Vector3f& up) {
  const Eigen::Vector3f d = high - low;
  const float rise = d.dot(up);
  const float run = (d - rise * up).norm();
  return std::atan2(rise, run) * static_cast<float>(2 / std::numbers::pi);
}

}  // namespace

const std::vector<float>& Features::compute(const RangeImage& raw) {
  spacing_.measure(raw);
  smooth_ranges(raw, spacing_, smooth_);
  const RangeImage& image = smooth_;
  ground_.estimate(image, spacing_);
  const std::size_t pixels = image.size();
  const Eigen::Vector3f up = ground_.up();
  values_.assign(kChannelCount * pixels, 0.0F);
  for (std::size_t i = 0; i < pixels; ++i) {
    if (!image.valid(i)) continue;
    const float range = image.range[i], height = ground_.height()[i];
    const int row = static_cast<int>(i / image.columns);
    const std::size_t next = right_of(image, i, 1), under = below(image, i, row + 1);
    const std::size_t right = right_of(image, i, spacing_.columns(range, kBaseline));
    const std::size_t low = below(image, i, spacing_.row_below(row, range, kBaseline));
    float* value = &values_[i];
    value[0] = 1;
    value[pixels] = std::log(range / 10);
    value[2 * pixels] = std::clamp(height / 3, -1.0F, 4.0F);
    value[3 * pixels] = std::clamp(height / 0.3F, -2.0F, 2.0F);
    value[4 * pixels] = ground_.normals()[i].dot(up);
    value[5 * pixels] = step(range, next == i ? 0 : image.range[next]);
    value[6 * pixels] = step(range, under == i ? 0 : image.range[under]);
    value[7 * pixels] = step(range, right == i ? 0 : image.range[right]);
    value[8 * pixels] = step(range, low == i ? 0 : image.range[low]);
    value[9 * pixels] = low == i ? 0 : slope_between(image.points[low], image.points[i], up);
    value[10 * pixels] = image.points[i].dot(up) / range;
    value[11 * pixels] = std::clamp(std::log(range * spacing_.pitch(row) / 0.3F) / 2, -2.0F, 2.0F);
  }
  return values_;
}

}  // namespace saker::segmentation
