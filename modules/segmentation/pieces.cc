#include "saker/segmentation/pieces.h"

#include <algorithm>
#include <cmath>

namespace saker::segmentation {

/// Takes the members that hang together with the seed, through others, out of `member`.
void Pieces::grow(std::int32_t seed, const RangeImage& image, const Eigen::Vector3f& up,
                  std::vector<std::uint8_t>& member) {
  piece_.assign(1, seed);
  member[seed] = 0;
  for (std::size_t taken = 0; taken < piece_.size(); ++taken) {
    const Eigen::Vector3f& from = image.points[piece_[taken]];
    const int row = piece_[taken] / image.columns, column = piece_[taken] % image.columns;
    const int last = std::min(row + reach_.rows, image.rows - 1);
    for (int r = std::max(row - reach_.rows, 0); r <= last; ++r) {
      for (int d = -reach_.columns; d <= reach_.columns; ++d) {
        const int c = ((column + d) % image.columns + image.columns) % image.columns;
        const std::int32_t other = r * image.columns + c;
        if (member[other] == 0) continue;
        const Eigen::Vector3f apart = image.points[other] - from;
        const float rise = apart.dot(up);
        if (std::abs(rise) > reach_.rise || (apart - rise * up).norm() > reach_.across) continue;
        member[other] = 0;
        piece_.push_back(other);
      }
    }
  }
}

float height_of(const std::vector<std::int32_t>& piece, const RangeImage& image,
                const Eigen::Vector3f& up) {
  float lowest = up.dot(image.points[piece.front()]), highest = lowest;
  for (const std::int32_t i : piece) {
    const float height = up.dot(image.points[i]);
    lowest = std::min(lowest, height);
    highest = std::max(highest, height);
  }
  return highest - lowest;
}

float sum_of(const std::vector<int>& classes, const float* pixel) {
  float sum = 0;
  for (const int k : classes) sum += pixel[k];
  return sum;
}

}  // namespace saker::segmentation
