#include "saker/segmentation/back_projection.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace saker::segmentation {
namespace {

constexpr int kRowsAround = 1, kColumnsAround = 2;
constexpr float kNear = 0.3F;  // m: a pixel's point this far away counts half
constexpr float kNowhere = std::numeric_limits<float>::infinity();  // the weight there is 0

}  // namespace

void BackProjection::fill_frame(const RangeImage& image, const PixelProbabilities& pixels) {
  const auto classes = static_cast<std::size_t>(pixels.classes);
  blocks_ = (classes + Block::SizeAtCompileTime - 1) / Block::SizeAtCompileTime;
  votes_.resize(blocks_);
  width_ = image.columns + Block::SizeAtCompileTime;
  const std::size_t size = static_cast<std::size_t>(image.rows + 2 * kRowsAround) * width_;
  for (std::vector<float>& axis : places_) axis.assign(size, kNowhere);
  of_pixels_.assign(size * blocks_, Block::Zero());
  for (int row = 0; row < image.rows; ++row) {
    for (int c = -kColumnsAround; c < image.columns + kColumnsAround; ++c) {
      const int column = (c + image.columns) % image.columns;
      const std::size_t i = static_cast<std::size_t>(row) * image.columns + column;
      if (!image.valid(i)) continue;
      const std::size_t at = framed(row, c);
      for (int k = 0; k < 3; ++k) places_[k][at] = image.points[i][k];
      std::copy_n(pixels.at(i), classes, of_pixels_[at * blocks_].data());
    }
  }
}

std::size_t BackProjection::framed(int row, int column) const {
  return static_cast<std::size_t>(row + kRowsAround) * width_ + column + kColumnsAround;
}

void BackProjection::vote(const Eigen::Vector3f& point, std::size_t centre) {
  constexpr int kRows = 2 * kRowsAround + 1, kColumns = 2 * kColumnsAround + 1;
  const std::size_t first = centre - kRowsAround * width_ - kColumnsAround;
  std::array<Block, kRows> weights;
  for (int r = 0; r < kRows; ++r) {
    Block square = Block::Zero();
    for (int k = 0; k < 3; ++k) {
      square += (Eigen::Map<const Block>(&places_[k][first + r * width_]) - point[k]).square();
    }
    weights[r] = (1 + square / (kNear * kNear)).inverse();
  }
  for (std::size_t b = 0; b < blocks_; ++b) {
    Block sum = Block::Zero();
    for (int r = 0; r < kRows; ++r) {
      const std::size_t begin = first + r * width_;
      for (int d = 0; d < kColumns; ++d) {
        sum += weights[r][d] * of_pixels_[(begin + d) * blocks_ + b];
      }
    }
    votes_[b] = sum;
  }
}

lidar::Labels BackProjection::label(const lidar::Scan& scan, const RangeImage& image,
                                    const PixelProbabilities& pixels) {
  lidar::Labels labels{std::vector<std::uint8_t>(scan.size(), 0),
                       std::vector<float>(scan.size(), 0.0F)};
  fill_frame(image, pixels);
  const float* votes = votes_.front().data();
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (image.pixel[i] < 0) continue;
    vote(scan.points[i], framed(image.pixel[i] / image.columns, image.pixel[i] % image.columns));
    const float sum = std::accumulate(votes, votes + pixels.classes, 0.0F);
    const float* best = std::max_element(votes, votes + pixels.classes);
    labels.classes[i] = static_cast<std::uint8_t>(best - votes);
    labels.probability[i] = sum > 0 ? *best / sum : 0.0F;
  }
  return labels;
}

}  // namespace saker::segmentation
