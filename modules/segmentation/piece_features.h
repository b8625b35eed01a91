#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "saker/segmentation/pieces.h"

namespace saker::segmentation {

/// What tells trunk, pole and neither apart in a piece of pixels that are likely a cylinder's. p is
/// a probability of the network; widths are across the line of sight; half of what a pixel covers
/// is added to a length, so that one pixel has some. The fit reads the same code (`saker evaluate
/// --pieces`).
inline constexpr std::array<const char*, 7> kPieceFeatures = {
    "one",
    "crowned_to_bare",  // mean of ln(p of trunks / p of poles)
    "cylinder",         // mean of ln(p / (1 − p)), p of both
    "width",            // ln(10th to 90th percentile across / 1 m)
    "width_squared",    // with it a log-normal of widths
    "height",           // ln(height / 1 m)
    "pixels",           // ln(their number)
};
inline constexpr int kPieceFeatureCount = static_cast<int>(kPieceFeatures.size());
using PieceFeatures = Eigen::Matrix<float, kPieceFeatureCount, 1>;

/// Probabilities of a piece: ln(P(kind) / P(neither)) = weights(kind) · features.
struct PieceModel {
  PieceFeatures crowned = PieceFeatures::Zero(), bare = PieceFeatures::Zero();
};

/// Measures pieces; keeps its memory between calls.
class PieceMeter {
 public:
  /// \param up             unit, lidar frame
  /// \param crowned, bare  classes of trunks and of poles
  [[nodiscard]] PieceFeatures measure(const std::vector<std::int32_t>& piece,
                                      const RangeImage& image, const Eigen::Vector3f& up,
                                      const std::vector<int>& crowned, const std::vector<int>& bare,
                                      const PixelProbabilities& pixels);

 private:
  [[nodiscard]] float width_across(const Eigen::Vector3f& direction,
                                   const std::vector<std::int32_t>& piece, const RangeImage& image);

  std::vector<float> scratch_;
};

}  // namespace saker::segmentation
