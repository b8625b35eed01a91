#pragma once

#include <cstdint>
#include <vector>

#include "saker/objects/class_table.h"
#include "saker/segmentation/pieces.h"

namespace saker::segmentation {

/// Lets the pixels of one trunk or pole decide together what it is. Reads the image and the
/// network's probabilities; changes the probabilities of classes that are cylinders.
///
/// A piece is what hangs together of the pixels that are more likely a cylinder than not. It is one
/// object, so that its pixels share one ratio of classes with leaves (trunks) to those without
/// (poles):
///
///   ln(P_trunk / P_pole) = w · mean of ln(p_trunk / p_pole) + ln p(width | trunk) - ln p(width |
///   pole)
///
/// where w tempers what the pixels say, for they are not independent, and the width, across the
/// line of sight, has the class table's log-normal (`size_m`, `width_sd_m`), widened by the pixels'
/// own width. A piece of a few pixels, or one that is both short and stout, is no cylinder: its
/// share goes to class 0. Classes of the table that state no slim width are told by the pixels
/// alone. Frame: lidar. Cost: 1 ms for 64×1024; allocates nothing after the first scans.
class CylinderPieces {
 public:
  explicit CylinderPieces(const objects::ClassTable& table);

  /// \param up  unit, lidar frame
  void decide(const RangeImage& image, const Eigen::Vector3f& up, PixelProbabilities& pixels);

 private:
  /// What the classes of a group, trunks or poles, have in common.
  struct Group {
    std::vector<int> classes;
    float width = 0;        ///< m, of the slimmest class; 0: none states one
    float relative_sd = 0;  ///< of the width

    [[nodiscard]] float log_likelihood(float width, float pixel_width) const;
  };

  /// A piece's extents, m.
  struct Extents {
    float height = 0;
    float width = 0;        ///< across the line of sight; 0 where that is vertical
    float pixel_width = 0;  ///< that one pixel covers across
  };

  using Piece = std::vector<std::int32_t>;

  [[nodiscard]] Extents measure(const Piece& piece, const RangeImage& image,
                                const Eigen::Vector3f& up);
  [[nodiscard]] float log_odds(const Piece& piece, const Extents& extents,
                               const PixelProbabilities& pixels) const;
  void share(const Piece& piece, float log_odds, PixelProbabilities& pixels) const;

  Group crowned_, bare_;
  std::vector<int> all_;  ///< classes of both
  Pieces pieces_;
  std::vector<std::uint8_t> member_;
  std::vector<float> scratch_;
};

}  // namespace saker::segmentation
