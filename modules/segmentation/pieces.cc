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

void PlanPieces::fill(const RangeImage& image, const Eigen::Vector3f& up,
                      std::vector<std::uint8_t>& member) {
  first_.assign(kSide * kSide, kNone);
  next_.resize(image.size());
  filled_.clear();
  const Eigen::Vector3f east = up.unitOrthogonal(), north = up.cross(east);
  for (std::size_t i = 0; i < member.size(); ++i) {
    if (member[i] == 0) continue;
    member[i] = 0;
    const Eigen::Vector2f flat(east.dot(image.points[i]), north.dot(image.points[i]));
    if (flat.cwiseAbs().maxCoeff() >= kReach_m) continue;
    const Eigen::Vector2i at = ((flat.array() + kReach_m) / kCell_m).cast<int>() + 1;
    const std::int32_t cell = std::min(at.x(), kSide - 2) * kSide + std::min(at.y(), kSide - 2);
    if (first_[cell] == kNone) filled_.push_back(cell);
    next_[i] = first_[cell];
    first_[cell] = static_cast<std::int32_t>(i);
  }
}

void PlanPieces::grow(std::int32_t seed) {
  piece_.clear();
  const auto take = [&](std::int32_t cell) {
    if (first_[cell] == kNone) return;
    for (std::int32_t i = first_[cell]; i != kNone; i = next_[i]) piece_.push_back(i);
    first_[cell] = kNone;
    open_.push_back(cell);
  };
  open_.clear();
  take(seed);
  while (!open_.empty()) {
    const std::int32_t cell = open_.back();
    open_.pop_back();
    for (int dx = -1; dx <= 1; ++dx)
      for (int dy = -1; dy <= 1; ++dy) take(cell + dx * kSide + dy);
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
