#pragma once

#include <Eigen/Core>
#include <algorithm>

namespace saker::occupancy {

/// A beam that nothing answers stands among a scan's points as one so far away, farther than any
/// return, or beyond it: it is no hit, and clears from the difference on.
inline constexpr float kOpenBeam_m = 200;

/// By which deskewing moves such a point, at most.
inline constexpr float kOpenBeamMoves_m = 5;

/// \param point  m, lidar frame
[[nodiscard]] inline bool is_open_beam(const Eigen::Vector3f& point) {
  return point.squaredNorm() > (kOpenBeam_m - kOpenBeamMoves_m) * (kOpenBeam_m - kOpenBeamMoves_m);
}

/// The range from which on the beam clears, m; 0 for a return.
[[nodiscard]] inline float clears_from_m(const Eigen::Vector3f& point) {
  return is_open_beam(point) ? std::max(point.norm() - kOpenBeam_m, 0.0F) : 0.0F;
}

}  // namespace saker::occupancy
