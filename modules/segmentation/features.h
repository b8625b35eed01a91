#pragma once

#include <array>
#include <vector>

#include "saker/segmentation/beam_spacing.h"
#include "saker/segmentation/ground_height.h"
#include "saker/segmentation/range_image.h"

namespace saker::segmentation {

/// What the network is given for each pixel. The training calls the same code (training_inputs.cc),
/// so there is one definition. Everything is geometry: simulated reflectivity is unlike any real
/// one. All values lie in about −3 … 3 without further normalisation and are 0 where nothing
/// returned. Neighbours are `kBaseline` away at least, but for edges the next pixel; ranges are
/// averaged (beam_spacing.h): but for edges and pitch nothing depends on how dense beams are.
inline constexpr std::array<const char*, 12> kChannels = {
    "valid",        // 1 where there is a return
    "log_range",    // ln(range / 10 m)
    "height",       // above the local ground, 3 m, −1 … 4
    "fine_height",  // above the local ground, 0.3 m, −2 … 2
    "normal_up",    // the surface normal's component along up; 0: no surface
    "right_edge",   // asinh((range of the next pixel − range) / 0.3 m) / 3; nothing there: 2
    "lower_edge",   // the same to the pixel below
    "right_step",   // the same to the neighbour to the right
    "lower_step",   // the same to the neighbour below
    "slope",        // of the line from the neighbour below, in right angles, −1 … 1
    "elevation",    // sine, over the local horizontal
    "row_pitch",    // ln(distance to the next lower beam at this range / 0.3 m) / 2, −2 … 2
};
inline constexpr int kChannelCount = static_cast<int>(kChannels.size());
inline constexpr int kRightEdge = 5, kRightStep = 7;  ///< what changes in a mirror

class Features {
 public:
  /// \param up  as GroundHeight's.
  explicit Features(const Eigen::Vector3f& up = Eigen::Vector3f::UnitZ()) : ground_(up) {}

  /// channel × row × column. Cost: 5 ms for 64×1024.
  const std::vector<float>& compute(const RangeImage& image);

  /// The same of the last image in a mirror: columns run the other way, and right is left.
  const std::vector<float>& mirrored();

  /// Unit, lidar frame, as found in the last image.
  [[nodiscard]] const Eigen::Vector3f& up() const { return ground_.up(); }

 private:
  BeamSpacing spacing_;
  RangeImage smooth_;
  GroundHeight ground_;
  std::size_t rows_ = 0, columns_ = 0;
  std::vector<float> values_, mirrored_;
  std::vector<float> leftward_;  ///< edges and steps to the left, of the image as it is
};

}  // namespace saker::segmentation
