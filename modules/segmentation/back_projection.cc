#include "segmentation/back_projection.h"

#include <algorithm>

namespace saker::segmentation {
namespace {

constexpr int kRowsAround = 1, kColumnsAround = 2;
constexpr float kNear = 0.15F;  // m: a pixel's point this far away counts half

}  // namespace

void BackProjection::vote(const Eigen::Vector3f& point, std::size_t pixel, const RangeImage& image,
                          const PixelProbabilities& pixels) {
  const int row = static_cast<int>(pixel) / image.columns;
  const int column = static_cast<int>(pixel) % image.columns;
  votes_.assign(static_cast<std::size_t>(pixels.classes), 0.0F);
  for (int r = std::max(row - kRowsAround, 0); r <= std::min(row + kRowsAround, image.rows - 1);
       ++r) {
    for (int d = -kColumnsAround; d <= kColumnsAround; ++d) {
      const int c = (column + d + image.columns) % image.columns;
      const std::size_t i = static_cast<std::size_t>(r) * image.columns + c;
      if (!image.valid(i)) continue;
      const float away = (image.points[i] - point).norm() / kNear;
      const float weight = 1 / (1 + away * away);
      for (int k = 0; k < pixels.classes; ++k)
        votes_[k] += weight * pixels.values[k * image.size() + i];
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
    if (image.point[pixel] == static_cast<std::int32_t>(i)) {
      for (int k = 0; k < pixels.classes; ++k) votes_[k] = pixels.values[k * image.size() + pixel];
    } else {
      vote(scan.points[i], pixel, image, pixels);
    }
    float sum = 0;
    for (const float v : votes_) sum += v;
    const auto best = std::max_element(votes_.begin(), votes_.end());
    labels.classes[i] = static_cast<std::uint8_t>(best - votes_.begin());
    labels.probability[i] = sum > 0 ? *best / sum : 0.0F;
  }
  return labels;
}

}  // namespace saker::segmentation
