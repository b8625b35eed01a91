#include "saker/segmentation/cylinder_pieces.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace saker::segmentation {
namespace {

constexpr float kLikely = 0.5F;  // of all cylinder classes together
constexpr int kRowsAround = 3;   // twigs and wires hide a row or two
constexpr int kColumnsAround = 2;
constexpr float kReach = 0.4F;         // m, horizontally between two pixels of a piece
constexpr float kRise = 1.0F;          // m, vertically: the rows of a sparse sensor
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

float CylinderPieces::Group::probability(const float* pixel) const {
  float sum = 0;
  for (const int k : classes) sum += pixel[k];
  return sum;
}

void CylinderPieces::Group::scale(float* pixel, float factor) const {
  for (const int k : classes) pixel[k] *= factor;
}

/// Pixels at both edges are partly beside the object: half of one's width is added, and one is the
/// standard deviation.
float CylinderPieces::Group::log_likelihood(float seen, float pixel_width) const {
  const float mean = width + 0.5F * pixel_width;
  const float sd = std::hypot(relative_sd * width, pixel_width) / mean;
  const float off = std::log(seen / mean) / sd;
  return -0.5F * off * off - std::log(sd);
}

CylinderPieces::CylinderPieces(const objects::ClassTable& table) {
  for (int k = 0; k < table.size(); ++k) {
    const objects::ObjectClass& c = table.classes[k];
    if (c.shape != objects::Shape::cylinder) continue;
    Group& group = c.crowned ? crowned_ : bare_;
    group.classes.push_back(k);
    const float width = c.size_m.size() == 3 ? static_cast<float>(c.size_m[1]) : kSlim;
    if (width >= kSlim || (group.width > 0 && group.width <= width)) continue;
    group.width = width;
    group.relative_sd = static_cast<float>(c.width_sd_m) / width;
  }
}

void CylinderPieces::decide(const RangeImage& image, const Eigen::Vector3f& up,
                            PixelProbabilities& pixels) {
  if (crowned_.classes.empty() && bare_.classes.empty()) return;
  find_members(image, pixels);
  for (std::size_t i = 0; i < member_.size(); ++i) {
    if (member_[i] == 0) continue;
    grow(static_cast<std::int32_t>(i), image, up);
    const Extents extents = measure(image, up);
    const bool stout = extents.height < kShort && extents.height < kSlenderness * extents.width;
    if (piece_.size() < kFewest || stout) {
      refuse(pixels);
    } else if (!crowned_.classes.empty() && !bare_.classes.empty()) {
      share(log_odds(extents, pixels), pixels);
    }
  }
}

void CylinderPieces::find_members(const RangeImage& image, const PixelProbabilities& pixels) {
  member_.assign(image.size(), 0);
  for (std::size_t i = 0; i < image.size(); ++i) {
    const float* pixel = pixels.at(i);
    member_[i] =
        image.valid(i) && crowned_.probability(pixel) + bare_.probability(pixel) > kLikely ? 1 : 0;
  }
}

/// Takes the members that hang together with the seed, through others, out of `member_`.
void CylinderPieces::grow(std::int32_t seed, const RangeImage& image, const Eigen::Vector3f& up) {
  piece_.assign(1, seed);
  member_[seed] = 0;
  for (std::size_t taken = 0; taken < piece_.size(); ++taken) {
    const Eigen::Vector3f& from = image.points[piece_[taken]];
    const int row = piece_[taken] / image.columns, column = piece_[taken] % image.columns;
    const int last = std::min(row + kRowsAround, image.rows - 1);
    for (int r = std::max(row - kRowsAround, 0); r <= last; ++r) {
      for (int d = -kColumnsAround; d <= kColumnsAround; ++d) {
        const int c = ((column + d) % image.columns + image.columns) % image.columns;
        const std::int32_t other = r * image.columns + c;
        if (member_[other] == 0) continue;
        const Eigen::Vector3f apart = image.points[other] - from;
        const float rise = apart.dot(up);
        if (std::abs(rise) > kRise || (apart - rise * up).norm() > kReach) continue;
        member_[other] = 0;
        piece_.push_back(other);
      }
    }
  }
}

CylinderPieces::Extents CylinderPieces::measure(const RangeImage& image,
                                                const Eigen::Vector3f& up) {
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  float lowest = up.dot(image.points[piece_.front()]), highest = lowest;
  for (const std::int32_t i : piece_) {
    const float height = up.dot(image.points[i]);
    lowest = std::min(lowest, height);
    highest = std::max(highest, height);
    sum += image.points[i];
  }
  const Eigen::Vector3f middle = sum / static_cast<float>(piece_.size());
  const Eigen::Vector3f across = up.cross(middle);
  const float pixel = 2 * std::numbers::pi_v<float> / static_cast<float>(image.columns);
  Extents extents{highest - lowest, 0, across.norm() * pixel};
  if (!(across.norm() > 0.1F)) return extents;
  scratch_.clear();
  for (const std::int32_t i : piece_) {
    scratch_.push_back(across.dot(image.points[i]) / across.norm());
  }
  const float low = percentile(scratch_, 0.1F);
  extents.width = (percentile(scratch_, 0.9F) - low) / kOfDisc;
  return extents;
}

/// Of crowned to bare.
float CylinderPieces::log_odds(const Extents& extents, const PixelProbabilities& pixels) const {
  float sum = 0;
  for (const std::int32_t i : piece_) {
    const float* pixel = pixels.at(static_cast<std::size_t>(i));
    sum += std::log(std::max(crowned_.probability(pixel), kLeastProbability) /
                    std::max(bare_.probability(pixel), kLeastProbability));
  }
  float odds = kPixelWeight * sum / static_cast<float>(piece_.size());
  if (extents.pixel_width > 0 && extents.width > 0 && crowned_.width > 0 && bare_.width > 0) {
    constexpr float kThinnest = 0.02F;  // m
    const float width = std::max(extents.width, kThinnest);
    odds += std::clamp(crowned_.log_likelihood(width, extents.pixel_width) -
                           bare_.log_likelihood(width, extents.pixel_width),
                       -kMostEvidence, kMostEvidence);
  }
  return odds;
}

void CylinderPieces::refuse(PixelProbabilities& pixels) const {
  for (const std::int32_t i : piece_) {
    float* pixel = &pixels.values[static_cast<std::size_t>(i) * pixels.classes];
    pixel[0] += crowned_.probability(pixel) + bare_.probability(pixel);
    crowned_.scale(pixel, 0);
    bare_.scale(pixel, 0);
  }
}

void CylinderPieces::share(float log_odds, PixelProbabilities& pixels) const {
  const float crowned_share = 1 / (1 + std::exp(-log_odds));
  for (const std::int32_t i : piece_) {
    float* pixel = &pixels.values[static_cast<std::size_t>(i) * pixels.classes];
    const float crowned = crowned_.probability(pixel), bare = bare_.probability(pixel);
    if (!(crowned > 0) || !(bare > 0)) continue;
    crowned_.scale(pixel, crowned_share * (crowned + bare) / crowned);
    bare_.scale(pixel, (1 - crowned_share) * (crowned + bare) / bare);
  }
}

}  // namespace saker::segmentation
