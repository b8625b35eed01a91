#include "saker/segmentation/piece_features.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace saker::segmentation {
namespace {

constexpr float kLeastProbability = 1e-3F;  // of single pixels: nothing is surer

/// Linear between the order statistics; reorders the values.
float percentile(std::vector<float>& values, float ratio) {
  const float place = ratio * static_cast<float>(values.size() - 1);
  const auto low = values.begin() + static_cast<std::ptrdiff_t>(place);
  std::nth_element(values.begin(), low, values.end());
  const float next = low + 1 == values.end() ? *low : *std::min_element(low + 1, values.end());
  return *low + (place - std::floor(place)) * (next - *low);
}

float log_ratio(float a, float b) {
  return std::log(std::max(a, kLeastProbability) / std::max(b, kLeastProbability));
}

}  // namespace

float PieceMeter::width_across(const Eigen::Vector3f& direction,
                               const std::vector<std::int32_t>& piece, const RangeImage& image) {
  scratch_.clear();
  for (const std::int32_t i : piece) scratch_.push_back(direction.dot(image.points[i]));
  const float low = percentile(scratch_, 0.1F);
  return percentile(scratch_, 0.9F) - low;
}

PieceFeatures PieceMeter::measure(const std::vector<std::int32_t>& piece, const RangeImage& image,
                                  const Eigen::Vector3f& up, const std::vector<int>& crowned,
                                  const std::vector<int>& bare, const PixelProbabilities& pixels) {
  float crowned_to_bare = 0, cylinder = 0;
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (const std::int32_t i : piece) {
    const float* pixel = pixels.at(static_cast<std::size_t>(i));
    const float with_crown = sum_of(crowned, pixel), without = sum_of(bare, pixel);
    crowned_to_bare += log_ratio(with_crown, without);
    cylinder += log_ratio(with_crown + without, 1 - with_crown - without);
    sum += image.points[i];
  }
  const auto count = static_cast<float>(piece.size());
  const Eigen::Vector3f across = up.cross(sum / count);
  const float half_pixel = std::max(across.norm(), lidar::kMinRange) * std::numbers::pi_v<float> /
                           static_cast<float>(image.columns);
  const float width = std::log(width_across(across.normalized(), piece, image) + half_pixel);
  const float height = std::log(height_of(piece, image, up) + half_pixel);
  PieceFeatures features;
  features << 1, crowned_to_bare / count, cylinder / count, width, width * width, height,
      std::log(count);
  return features;
}

}  // namespace saker::segmentation
