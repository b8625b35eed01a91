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

/// Of the highest pixel over the lowest, m.
[[nodiscard]] float height_of(const std::vector<std::int32_t>& piece, const RangeImage& image,
                              const Eigen::Vector3f& up);

/// The probability of some classes together at a pixel.
[[nodiscard]] float sum_of(const std::vector<int>& classes, const float* pixel);

}  // namespace saker::segmentation
