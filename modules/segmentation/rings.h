#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace saker::segmentation {

/// Which beam each point of an unorganised scan came from.
struct Rings {
  int count = 1;                       ///< at least 1, at most kMaxRings
  float azimuth_step = 0;              ///< rad between neighbours in a ring, median; 0: unknown
  std::vector<std::int32_t> of_point;  ///< 0 the highest; −1 for a point that is not finite
  bool from_order = false;             ///< false: elevation bins
};

inline constexpr int kMaxRings = 140;

/// Files keep the points ring by ring: a ring ends where the azimuth has gone once around, or
/// jumps back ("scan unfolding", Triess et al., IV 2020). Where the order says nothing of that kind
/// (too few or too many rings, or rings that are not thin in elevation) the elevation is cut into
/// 64 equal bins.
[[nodiscard]] Rings recover_rings(const std::vector<Eigen::Vector3f>& points);

}  // namespace saker::segmentation
