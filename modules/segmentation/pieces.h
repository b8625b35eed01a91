#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "saker/segmentation/network.h"
#include "saker/segmentation/range_image.h"

namespace saker::segmentation {

/// How far two pixels of one piece may be apart.
struct PieceReach {
  int rows = 3, columns = 3;  ///< what hides some of the beams between them
  float across = 0.5F;        ///< m, horizontally
  float rise = 1.0F;          ///< m, vertically: the rows of a sparse sensor
};

/// What hangs together in space of some pixels of an image: a piece is one object, or a part of
/// one. Keeps its memory between calls.
class Pieces {
 public:
  explicit Pieces(const PieceReach& reach) : reach_(reach) {}

  /// Calls `take(piece)` with the pixels of each piece, in the order of their first ones.
  /// \param up      unit, lidar frame
  /// \param member  of each pixel, 0 where nothing returned; all are 0 afterwards
  template <class Take>
  void for_each(const RangeImage& image, const Eigen::Vector3f& up,
                std::vector<std::uint8_t>& member, const Take& take) {
    for (std::size_t i = 0; i < member.size(); ++i) {
      if (member[i] == 0) continue;
      grow(static_cast<std::int32_t>(i), image, up, member);
      take(piece_);
    }
  }

 private:
  void grow(std::int32_t seed, const RangeImage& image, const Eigen::Vector3f& up,
            std::vector<std::uint8_t>& member);

  PieceReach reach_;
  std::vector<std::int32_t> piece_;
};

/// What hangs together seen from above, of some pixels of an image: cells of a horizontal grid that
/// touch. Larger than a piece of `Pieces`: what hides some of an object's pixels does not part it.
/// Keeps its memory between calls.
class PlanPieces {
 public:
  static constexpr float kReach_m = 60;  ///< pixels farther away are in no piece
  static constexpr float kCell_m = 0.5F;

  /// As Pieces::for_each.
  template <class Take>
  void for_each(const RangeImage& image, const Eigen::Vector3f& up,
                std::vector<std::uint8_t>& member, const Take& take) {
    fill(image, up, member);
    for (const std::int32_t cell : filled_) {
      if (first_[cell] == kNone) continue;
      grow(cell);
      take(piece_);
    }
  }

 private:
  static constexpr std::int32_t kNone = -1;
  static constexpr int kSide = static_cast<int>(2 * kReach_m / kCell_m) + 2;  ///< with a margin

  void fill(const RangeImage& image, const Eigen::Vector3f& up, std::vector<std::uint8_t>& member);
  void grow(std::int32_t cell);

  std::vector<std::int32_t> first_;   ///< pixel of each cell; kNone: empty, or taken
  std::vector<std::int32_t> next_;    ///< pixel of the same cell, of each pixel
  std::vector<std::int32_t> filled_;  ///< cells
  std::vector<std::int32_t> open_;
  std::vector<std::int32_t> piece_;
};

/// Of the highest pixel over the lowest, m.
[[nodiscard]] float height_of(const std::vector<std::int32_t>& piece, const RangeImage& image,
                              const Eigen::Vector3f& up);

/// The probability of some classes together at a pixel.
[[nodiscard]] float sum_of(const std::vector<int>& classes, const float* pixel);

}  // namespace saker::segmentation
