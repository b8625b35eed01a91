#include "segmentation/features.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace saker::segmentation {
namespace {

constexpr int kReach = 3;         // pixels over which a neighbour is sought
constexpr float kNothing = 2.0F;  // step to no return at all: sky

float step(float from, float to) {
  if (!(to > 0)) return kNothing;
  return std::clamp(std::asinh((to - from) / 0.3F) / 3, -kNothing, kNothing);
}

std::size_t right_of(const RangeImage& image, std::size_t i) {
  const std::size_t columns = image.columns, begin = i / columns * columns;
  for (std::size_t d = 1; d <= kReach; ++d) {
    const std::size_t other = begin + (i - begin + d) % columns;
    if (image.valid(other)) return other;
  }
  return i;
}

std::size_t below(const RangeImage& image, std::size_t i) {
  for (std::size_t d = 1; d <= kReach; ++d) {
    const std::size_t other = i + d * static_cast<std::size_t>(image.columns);
    if (other < image.size() && image.valid(other)) return other;
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

const std::vector<float>& Features::compute(const RangeImage& image) {
  ground_.estimate(image);
  const std::size_t pixels = image.size();
  const Eigen::Vector3f up = ground_.up();
  values_.assign(kChannelCount * pixels, 0.0F);
  for (std::size_t i = 0; i < pixels; ++i) {
    if (!image.valid(i)) continue;
    const float range = image.range[i], height = ground_.height()[i];
    const std::size_t right = right_of(image, i), low = below(image, i);
    float* value = &values_[i];
    value[0] = 1;
    value[pixels] = std::log(range / 10);
    value[2 * pixels] = std::clamp(height / 3, -1.0F, 4.0F);
    value[3 * pixels] = std::clamp(height / 0.3F, -2.0F, 2.0F);
    value[4 * pixels] = ground_.normals()[i].dot(up);
    value[5 * pixels] = step(range, right == i ? 0 : image.range[right]);
    value[6 * pixels] = step(range, low == i ? 0 : image.range[low]);
    value[7 * pixels] = low == i ? 0 : slope_between(image.points[low], image.points[i], up);
    value[8 * pixels] = image.points[i].dot(up) / range;
  }
  return values_;
}

}  // namespace saker::segmentation
