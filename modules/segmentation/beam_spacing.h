#pragma once

#include <vector>

#include "saker/segmentation/range_image.h"

namespace saker::segmentation {

/// Differences between pixels are taken over this many metres at least: between neighbours that
/// are a centimetre apart they would be the sensor's noise.
inline constexpr float kBaseline = 0.2F;

/// How far apart the beams of a range image are, so that what is computed from neighbours is over
/// metres and means the same for dense sensors and sparse ones.
class BeamSpacing {
 public:
  void measure(const RangeImage& image);

  /// Columns that span `metres` at a range; at least 1.
  [[nodiscard]] int columns(float range, float metres) const;
  /// The first row below `row` that is `metres` away from it at a range, or the last one.
  [[nodiscard]] int row_below(int row, float range, float metres) const;
  /// The same above it, or the first one.
  [[nodiscard]] int row_above(int row, float range, float metres) const;
  /// rad to the next lower beam; of the lowest: to the next higher.
  [[nodiscard]] float pitch(int row) const { return pitch_[static_cast<std::size_t>(row)]; }

 private:
  float column_pitch_ = 0;        // rad
  std::vector<float> elevation_;  // rad, mean of each row
  std::vector<float> pitch_;      // rad, of each row
};

/// The image with each range averaged along its row over what lies on the same surface within
/// 0.1 m: the noise of sensors whose points are dense, and nothing else, gets less.
void smooth_ranges(const RangeImage& image, const BeamSpacing& spacing, RangeImage& smooth);

}  // namespace saker::segmentation
