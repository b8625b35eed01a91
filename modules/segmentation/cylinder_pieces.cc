#include "saker/segmentation/cylinder_pieces.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace saker::segmentation {
namespace {

constexpr float kLikely = 0.5F;  // of all cylinder classes together
constexpr PieceReach kReach{.rows = 3, .columns = 2, .across = 0.4F, .rise = 1.0F};
constexpr std::size_t kFewest = 4;     // pixels: of fewer, nine in ten are leaves and edges
constexpr float kShort = 1.0F;         // m: what is shorter, and …
constexpr float kSlenderness = 3;      // … not so many times as high as wide, is no cylinder
constexpr float kPixelWeight = 0.75F;  // of the pixels' mean log odds
constexpr float kLeastProbability = 1e-3F;
constexpr float kMostEvidence = 8;  // of the width: no likelihood is known farther out
constexpr float kSlim = 1.0F;       // m: a class that states a wider one states a vehicle's
constexpr float kOfDisc = 0.8F;     // 10th to 90th percentile across a disc, of its diameter

/// Linear between the order statistics; reorders the values.
float percentile(std::vector<float>& values, float ratio) {
  const float place = ratio * static_cast<float>(values.size() - 1);
  const auto low = values.begin() + static_cast<std::ptrdiff_t>(place);
  std::nth_element(values.begin(), low, values.end());
  const float next = low + 1 == values.end() ? *low : *std::min_element(low + 1, values.end());
  return *low + (place - std::floor(place)) * (next - *low);
}

}  // namespace

/// Pixels at both edges are partly beside the object: half of one's width is added, and one is the
/// standard deviation.
float CylinderPieces::Group::log_likelihood(float seen, float pixel_width) const {
  const float mean = width + 0.5F * pixel_width;
  const float sd = std::hypot(relative_sd * width, pixel_width) / mean;
  const float off = std::log(seen / mean) / sd;
  return -0.5F * off * off - std::log(sd);
}

CylinderPieces::CylinderPieces(const objects::ClassTable& table) : pieces_(kReach) {
  for (int k = 0; k < table.size(); ++k) {
    const objects::ObjectClass& c = table.classes[k];
    if (c.shape != objects::Shape::cylinder) continue;
    Group& group = c.crowned ? crowned_ : bare_;
    group.classes.push_back(k);
    all_.push_back(k);
    const float width = c.size_m.size() == 3 ? static_cast<float>(c.size_m[1]) : kSlim;
    if (width >= kSlim || (group.width > 0 && group.width <= width)) continue;
    group.width = width;
    group.relative_sd = static_cast<float>(c.width_sd_m) / width;
  }
}

void CylinderPieces::decide(const RangeImage& image, const Eigen::Vector3f& up,
                            PixelProbabilities& pixels) {
  if (all_.empty()) return;
  member_.assign(image.size(), 0);
  for (std::size_t i = 0; i < image.size(); ++i) {
    member_[i] = image.valid(i) && sum_of(all_, pixels.at(i)) > kLikely ? 1 : 0;
  }
  pieces_.for_each(image, up, member_, [&](const Piece& piece) {
    const Extents extents = measure(piece, image, up);
    const bool stout = extents.height < kShort && extents.height < kSlenderness * extents.width;
    if (piece.size() < kFewest || stout) {
      refuse(piece, all_, pixels);
    } else if (!crowned_.classes.empty() && !bare_.classes.empty()) {
      share(piece, log_odds(piece, extents, pixels), pixels);
    }
  });
}

CylinderPieces::Extents CylinderPieces::measure(const Piece& piece, const RangeImage& image,
                                                const Eigen::Vector3f& up) {
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (const std::int32_t i : piece) sum += image.points[i];
  const Eigen::Vector3f middle = sum / static_cast<float>(piece.size());
  const Eigen::Vector3f across = up.cross(middle);
  const float pixel = 2 * std::numbers::pi_v<float> / static_cast<float>(image.columns);
  Extents extents{height_of(piece, image, up), 0, across.norm() * pixel};
  if (!(across.norm() > 0.1F)) return extents;
  scratch_.clear();
  for (const std::int32_t i : piece) {
    scratch_.push_back(across.dot(image.points[i]) / across.norm());
  }
  const float low = percentile(scratch_, 0.1F);
  extents.width = (percentile(scratch_, 0.9F) - low) / kOfDisc;
  return extents;
}

/// Of crowned to bare.
float CylinderPieces::log_odds(const Piece& piece, const Extents& extents,
                               const PixelProbabilities& pixels) const {
  float sum = 0;
  for (const std::int32_t i : piece) {
    const float* pixel = pixels.at(static_cast<std::size_t>(i));
    sum += std::log(std::max(sum_of(crowned_.classes, pixel), kLeastProbability) /
                    std::max(sum_of(bare_.classes, pixel), kLeastProbability));
  }
  float odds = kPixelWeight * sum / static_cast<float>(piece.size());
  if (extents.pixel_width > 0 && extents.width > 0 && crowned_.width > 0 && bare_.width > 0) {
    constexpr float kThinnest = 0.02F;  // m
    const float width = std::max(extents.width, kThinnest);
    odds += std::clamp(crowned_.log_likelihood(width, extents.pixel_width) -
                           bare_.log_likelihood(width, extents.pixel_width),
                       -kMostEvidence, kMostEvidence);
  }
  return odds;
}

void CylinderPieces::share(const Piece& piece, float log_odds, PixelProbabilities& pixels) const {
  constexpr float kSmallest = std::numeric_limits<float>::min();  // less has no finite inverse
  const float crowned_share = 1 / (1 + std::exp(-log_odds));
  for (const std::int32_t i : piece) {
    float* pixel = &pixels.values[static_cast<std::size_t>(i) * pixels.classes];
    const float crowned = sum_of(crowned_.classes, pixel), bare = sum_of(bare_.classes, pixel);
    if (!(crowned >= kSmallest) || !(bare >= kSmallest)) continue;
    for (const int k : crowned_.classes) pixel[k] *= crowned_share * (crowned + bare) / crowned;
    for (const int k : bare_.classes) pixel[k] *= (1 - crowned_share) * (crowned + bare) / bare;
  }
}

}  // namespace saker::segmentation
