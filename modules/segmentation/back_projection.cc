#include "saker/segmentation/back_projection.h"

#include <algorithm>
#include <numeric>

namespace saker::segmentation {
namespace {

constexpr int kRowsAround = 1, kColumnsAround = 2;
constexpr float kNear = 0.3F;  // m: a pixel's point this far away counts half

int wrapped(int column, int columns) {
  if (column < 0) return (column + columns) % columns;
  return column < columns ? column : column % columns;
}

}  // namespace

void BackProjection::fill_blocks(const PixelProbabilities& pixels) {
  const auto classes = static_cast<std::size_t>(pixels.classes);
  blocks_ = (classes + Block::SizeAtCompileTime - 1) / Block::SizeAtCompileTime;
  votes_.resize(blocks_);
  of_pixels_.assign(pixels.values.size() / classes * blocks_, Block::Zero());
  for (std::size_t i = 0; i * blocks_ < of_pixels_.size(); ++i) {
    std::copy_n(pixels.at(i), classes, of_pixels_[i * blocks_].data());
  }
}

void BackProjection::vote(const Eigen::Vector3f& point, std::size_t pixel,
                          const RangeImage& image) {
  const int row = static_cast<int>(pixel) / image.columns;
  const int column = static_cast<int>(pixel) % image.columns;
  std::ranges::fill(votes_, Block::Zero());
  for (int r = std::max(row - kRowsAround, 0); r <= std::min(row + kRowsAround, image.rows - 1);
       ++r) {
    for (int d = -kColumnsAround; d <= kColumnsAround; ++d) {
      const std::size_t i =
          static_cast<std::size_t>(r) * image.columns + wrapped(column + d, image.columns);
      if (!image.valid(i)) continue;
      const float weight = 1 / (1 + (image.points[i] - point).squaredNorm() / (kNear * kNear));
      for (std::size_t b = 0; b < blocks_; ++b) votes_[b] += weight * of_pixels_[i * blocks_ + b];
    }
  }
}

lidar::Labels BackProjection::label(const lidar::Scan& scan, const RangeImage& image,
                                    const PixelProbabilities& pixels) {
  lidar::Labels labels{std::vector<std::uint8_t>(scan.size(), 0),
                       std::vector<float>(scan.size(), 0.0F)};
  fill_blocks(pixels);
  const float* votes = votes_.front().data();
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (image.pixel[i] < 0) continue;
    vote(scan.points[i], static_cast<std::size_t>(image.pixel[i]), image);
    const float sum = std::accumulate(votes, votes + pixels.classes, 0.0F);
    const float* best = std::max_element(votes, votes + pixels.classes);
    labels.classes[i] = static_cast<std::uint8_t>(best - votes);
    labels.probability[i] = sum > 0 ? *best / sum : 0.0F;
  }
  return labels;
}

}  // namespace saker::segmentation
