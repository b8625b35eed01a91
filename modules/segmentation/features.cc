#include "saker/segmentation/features.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "saker/segmentation/blockwise.h"

namespace saker::segmentation {
namespace {

constexpr int kReach = 3;         // pixels over which a neighbour is sought where one is missing
constexpr float kNothing = 2.0F;  // step to no return at all: sky
constexpr float kSky = 1e6F;      // m, in place of its range

enum Side { left = -1, right = 1 };

/// The first pixel with a return from `columns` to a side on, or i itself.
std::size_t beside(const RangeImage& image, std::size_t i, int columns, Side side) {
  const int width = image.columns;
  const std::size_t begin = i / width * width;
  int column = static_cast<int>(i - begin) + side * columns % width;
  for (int tries = 0; tries < kReach; ++tries, column += side) {
    if (column < 0) column += width;
    if (column >= width) column -= width;
    if (image.valid(begin + column)) return begin + column;
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

/// From one pixel to another, m; both the same where nothing returned.
float step(const RangeImage& image, std::size_t from, std::size_t to) {
  return (to == from ? kSky : image.range[to]) - image.range[from];
}

/// asinh(step / 0.3 m) / 3, to kNothing.
void tame_steps(float* steps, std::size_t count) {
  for_each_block(steps, count, [](Block& step) {
    const Block size = step.abs() / 0.3F;
    step = step.sign() * ((size + (size.square() + 1).sqrt()).log() / 3).min(kNothing);
  });
}

}  // namespace

const std::vector<float>& Features::compute(const RangeImage& raw) {
  spacing_.measure(raw);
  smooth_ranges(raw, spacing_, smooth_);
  const RangeImage& image = smooth_;
  ground_.estimate(image, spacing_);
  const std::size_t pixels = image.size();
  const Eigen::Vector3f up = ground_.up();
  rows_ = image.rows, columns_ = image.columns;
  values_.assign(kChannelCount * pixels, 0.0F);
  leftward_.assign(2 * pixels, 0.0F);
  float* log_range = values_.data() + pixels;
  float* pitch = values_.data() + (kChannelCount - 1) * pixels;
  std::fill_n(log_range, pixels, 1.0F);  // ln 1 where nothing returned
  std::fill_n(pitch, pixels, 1.0F);
  for (std::size_t i = 0; i < pixels; ++i) {
    if (!image.valid(i)) continue;
    const float range = image.range[i], height = ground_.height()[i];
    const int row = static_cast<int>(i / image.columns);
    const int away = spacing_.columns(range, kBaseline);
    const std::size_t under = below(image, i, row + 1);
    const std::size_t low = below(image, i, spacing_.row_below(row, range, kBaseline));
    float* value = &values_[i];
    value[0] = 1;
    value[pixels] = range / 10;
    value[2 * pixels] = std::clamp(height / 3, -1.0F, 4.0F);
    value[3 * pixels] = std::clamp(height / 0.3F, -2.0F, 2.0F);
    value[4 * pixels] = ground_.normals()[i].dot(up);
    value[kRightEdge * pixels] = step(image, i, beside(image, i, 1, right));
    value[6 * pixels] = step(image, i, under);
    value[kRightStep * pixels] = step(image, i, beside(image, i, away, right));
    value[8 * pixels] = step(image, i, low);
    value[9 * pixels] = low == i ? 0 : slope_between(image.points[low], image.points[i], up);
    value[10 * pixels] = image.points[i].dot(up) / range;
    value[11 * pixels] = range * spacing_.pitch(row) / 0.3F;
    leftward_[i] = step(image, i, beside(image, i, 1, left));
    leftward_[pixels + i] = step(image, i, beside(image, i, away, left));
  }
  for_each_block(log_range, pixels, [](Block& v) { v = v.log(); });
  for_each_block(pitch, pixels, [](Block& v) { v = (v.log() / 2).max(-2.0F).min(2.0F); });
  tame_steps(values_.data() + kRightEdge * pixels, 4 * pixels);
  tame_steps(leftward_.data(), leftward_.size());
  return values_;
}

const std::vector<float>& Features::mirrored() {
  mirrored_.resize(values_.size());
  const std::size_t width = columns_, pixels = rows_ * width;
  for (std::size_t channel = 0; channel < kChannelCount; ++channel) {
    const float* from = &values_[channel * pixels];
    if (channel == kRightEdge) from = leftward_.data();
    if (channel == kRightStep) from = &leftward_[pixels];
    float* to = &mirrored_[channel * pixels];
    for (std::size_t begin = 0; begin < pixels; begin += width) {
      std::reverse_copy(from + begin, from + begin + width, to + begin);
    }
  }
  return mirrored_;
}

}  // namespace saker::segmentation
