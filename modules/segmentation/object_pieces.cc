#include "saker/segmentation/object_pieces.h"

#include <algorithm>
#include <limits>

namespace saker::segmentation {
namespace {

constexpr PieceReach kReach{.rows = 3, .columns = 2, .across = 0.4F, .rise = 1.0F};  // of cylinders

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

ObjectPieces::ObjectPieces(PieceFamily family, const objects::ClassTable& table,
                           const std::optional<PieceModel>& model)
    : family_(family),
      kinds_(info_of(family).kinds.size()),
      model_(model),
      pieces_(kReach),
      meter_(family) {
  for (int k = 0; k < table.size(); ++k) {
    const int kind = kind_of(family, table.classes[k]);
    (kind < 0 ? neither_ : kinds_[kind]).push_back(k);
  }
  all_kinds_ = !neither_.empty() &&
               std::ranges::none_of(kinds_, [](const auto& classes) { return classes.empty(); });
}

void ObjectPieces::decide(const RangeImage& image, const Eigen::Vector3f& up,
                          PixelProbabilities& pixels) {
  if (!model_) return;
  for_each(image, up, pixels, [&](const Piece& piece, const PieceFeatures& features) {
    share(piece, features, pixels);
  });
}

void ObjectPieces::find_members(const RangeImage& image, const PixelProbabilities& pixels) {
  member_.assign(image.size(), 0);
  for (std::size_t i = 0; i < image.size(); ++i) {
    if (!image.valid(i)) continue;
    const float* pixel = pixels.at(i);
    float likely = 0, other = 0;
    for (const std::vector<int>& classes : kinds_) likely += sum_of(classes, pixel);
    for (const int k : neither_) other = std::max(other, pixel[k]);
    member_[i] = likely > other ? 1 : 0;
  }
}

void ObjectPieces::share(const Piece& piece, const PieceFeatures& features,
                         PixelProbabilities& pixels) const {
  const auto kinds = static_cast<Eigen::Index>(kinds_.size());
  Eigen::Array<float, Eigen::Dynamic, 1, 0, 3, 1> share(kinds + 1);
  for (Eigen::Index k = 0; k < kinds; ++k) share[k] = model_->kinds[k].dot(features);
  share[kinds] = 0;
  share = (share - share.maxCoeff()).exp();
  share /= share.sum();
  for (const std::int32_t i : piece) {
    float* pixel = &pixels.values[static_cast<std::size_t>(i) * pixels.classes];
    for (Eigen::Index k = 0; k < kinds; ++k) give(kinds_[k], share[k], pixel);
    give(neither_, share[kinds], pixel);
  }
}

}  // namespace saker::segmentation
