#include "segmentation/back_projection.h"

#include <algorithm>

namespace saker::segmentation {
namespace {

constexpr int kRowsAround = 1, kColumnsAround = 2;
constexpr float kNear = 0.3F;  // m: a pixel's point this far away counts half

int wrapped(int column, int columns) {
  if (column < 0) return (column + columns) % columns;
  return column < columns ? column : column % columns;
}

}  // namespace

void BackProjection::vote(const Eigen::Vector3f& point, std::size_t pixel, const RangeImage& image,
                          const PixelProbabilities& pixels) {
  const int row = static_cast<int>(pixel) / image.columns;
  const int column = static_cast<int>(pixel) % image.columns;
  votes_.assign(static_cast<std::size_t>(pixels.classes), 0.0F);
  for (int r = std::max(row - kRowsAround, 0); r <= std::min(row + kRowsAround, image.rows - 1);
       ++r) {
    for (int d = -kColumnsAround; d <= kColumnsAround; ++d) {
      const std::size_t i =
          static_cast<std::size_t>(r) * image.columns + wrapped(column + d, image.columns);
      if (!image.valid(i)) continue;
      const float weight = 1 / (1 + (image.points[i] - point).squaredNorm() / (kNear * kNear));
      const float* probability = pixels.at(i);
      for (int k = 0; k < pixels.classes; ++k) votes_[k] += weight * probability[k];
    }
  }
}

lidar::Labels BackProjection::label(const lidar::Scan& scan, const RangeImage& image,
                                    const PixelProbabilities& pixels) {
  lidar::Labels labels{std::vector<std::uint8_t>(scan.size(), 0),
                       std::vector<float>(scan.size(), 0.0F)};
  votes_.resize(static_cast<std::size_t>(pixels.classes));
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (image.pixel[i] < 0) continue;
    const std::size_t pixel = image.pixel[i];
    vote(scan.points[i], pixel, image, pixels);
    float sum = 0;
    for (const float v : votes_) sum += v;
    const auto best = std::max_element(votes_.begin(), votes_.end());
    labels.classes[i] = static_cast<std::uint8_t>(best - votes_.begin());
    labels.probability[i] = sum > 0 ? *best / sum : 0.0F;
  }
  return labels;
}

}  // namespace saker::segmentation
