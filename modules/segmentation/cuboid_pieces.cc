#include "saker/segmentation/cuboid_pieces.h"

#include <algorithm>
#include <limits>

namespace saker::segmentation {
namespace {

constexpr float kLikely = 0.5F;    // of all cuboid classes together
constexpr float kLowShare = 0.6F;  // of the height of a class: what two rows of others leave to see
constexpr float kSure = 0.7F;      // mean probability of a low piece's pixels
constexpr PieceReach kReach{.rows = 3, .columns = 3, .across = 0.6F, .rise = 1.0F};

}  // namespace

CuboidPieces::CuboidPieces(const objects::ClassTable& table) : pieces_(kReach) {
  low_ = std::numeric_limits<float>::infinity();
  for (int k = 0; k < table.size(); ++k) {
    const objects::ObjectClass& c = table.classes[k];
    if (c.shape != objects::Shape::cuboid) continue;
    classes_.push_back(k);
    const float height = c.size_m.size() == 3 ? static_cast<float>(c.size_m[2]) : 0;
    low_ = std::min(low_, kLowShare * height);
  }
}

void CuboidPieces::decide(const RangeImage& image, const Eigen::Vector3f& up,
                          PixelProbabilities& pixels) {
  if (classes_.empty()) return;
  member_.assign(image.size(), 0);
  for (std::size_t i = 0; i < image.size(); ++i) {
    member_[i] = image.valid(i) && sum_of(classes_, pixels.at(i)) > kLikely ? 1 : 0;
  }
  pieces_.for_each(image, up, member_, [&](const std::vector<std::int32_t>& piece) {
    if (height_of(piece, image, up) >= low_ || sure(piece, pixels)) return;
    refuse(piece, classes_, pixels);
  });
}

bool CuboidPieces::sure(const std::vector<std::int32_t>& piece,
                        const PixelProbabilities& pixels) const {
  float sum = 0;
  for (const std::int32_t i : piece) {
    sum += sum_of(classes_, pixels.at(static_cast<std::size_t>(i)));
  }
  return sum >= kSure * static_cast<float>(piece.size());
}

}  // namespace saker::segmentation
