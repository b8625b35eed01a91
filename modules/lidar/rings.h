#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace saker::lidar {

/// How the beams of a scan were told apart.
enum class RingSource {
  none,   ///< no finite point
  given,  ///< the recording has ring numbers
  order,  ///< the file goes ring by ring
  bands,  ///< bands of elevation that hold one beam each (elevation_bands.h)
};

/// Which beam each point of an unorganised scan came from.
struct Rings {
  int count = 1;                       ///< at least 1, at most kMaxRings
  float azimuth_step = 0;              ///< rad between neighbours in a ring; 0: unknown
  std::vector<std::int32_t> of_point;  ///< 0 the highest; −1 for a point that is not finite
  std::vector<float> azimuth;          ///< rad, of each point; 0 for one that is not finite
  RingSource source = RingSource::none;
};

inline constexpr int kMaxRings = 140;

/// Points nearer than this are the sensor's own housing or no return at all.
inline constexpr float kMinRange = 0.3F;

/// Ring numbers count where they are given and each names a thin cone. Else files that keep the
/// points ring by ring are unfolded: a ring ends where the azimuth has gone once around, or jumps
/// back ("scan unfolding", Triess et al., IV 2020). Where the order says nothing of that kind (too
/// few or too many rings, or rings that are not thin in elevation) the elevation is cut into bands
/// of one beam each.
/// \param points  in the sensor's frame, m
/// \param given   ring number of each point, in any order of height; or empty
[[nodiscard]] Rings recover_rings(const std::vector<Eigen::Vector3f>& points,
                                  const std::vector<std::uint16_t>& given = {});

}  // namespace saker::lidar
