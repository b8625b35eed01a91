#include "saker/segmentation/cylinder_pieces.h"

#include <limits>

namespace saker::segmentation {
namespace {

constexpr float kLikely = 0.5F;  // of all cylinder classes together
constexpr PieceReach kReach{.rows = 3, .columns = 2, .across = 0.4F, .rise = 1.0F};

/// Gives the classes so much together, in the ratios that they have.
void give(const std::vector<int>& classes, float probability, float* pixel) {
  constexpr float kSmallest = std::numeric_limits<float>::min();  // less has no finite inverse
  const float had = sum_of(classes, pixel);
  if (had < kSmallest) {
    pixel[classes.front()] = probability;
    return;
  }
  for (const int k : classes) pixel[k] *= probability / had;
}

}  // namespace

CylinderPieces::CylinderPieces(const objects::ClassTable& table,
                               const std::optional<PieceModel>& model)
    : model_(model), pieces_(kReach) {
  for (int k = 0; k < table.size(); ++k) {
    const objects::ObjectClass& c = table.classes[k];
    const bool cylinder = c.shape == objects::Shape::cylinder;
    (!cylinder ? neither_ : c.crowned ? crowned_ : bare_).push_back(k);
  }
}

void CylinderPieces::decide(const RangeImage& image, const Eigen::Vector3f& up,
                            PixelProbabilities& pixels) {
  if (!model_) return;
  for_each(image, up, pixels, [&](const Piece& piece, const PieceFeatures& features) {
    share(piece, features, pixels);
  });
}

void CylinderPieces::find_members(const RangeImage& image, const PixelProbabilities& pixels) {
  member_.assign(image.size(), 0);
  for (std::size_t i = 0; i < image.size(); ++i) {
    if (!image.valid(i)) continue;
    const float* pixel = pixels.at(i);
    member_[i] = sum_of(crowned_, pixel) + sum_of(bare_, pixel) > kLikely ? 1 : 0;
  }
}

void CylinderPieces::share(const Piece& piece, const PieceFeatures& features,
                           PixelProbabilities& pixels) const {
  Eigen::Array3f share(model_->crowned.dot(features), model_->bare.dot(features), 0);
  share = (share - share.maxCoeff()).exp();
  share /= share.sum();
  for (const std::int32_t i : piece) {
    float* pixel = &pixels.values[static_cast<std::size_t>(i) * pixels.classes];
    give(crowned_, share[0], pixel);
    give(bare_, share[1], pixel);
    give(neither_, share[2], pixel);
  }
}

}  // namespace saker::segmentation
