#pragma once

#include "saker/simulation/mission/given_path.h"
#include "saker/simulation/mission/scenario.h"

namespace saker::simulation {

/// Where a LiDAR is at any time: a spiral about an object, outwards or inwards, either way round.
/// The range grows at a constant rate, so that all ranges get the same time; the height swings
/// within its limits for that range, whatever the range is.
class SpiralPath {
 public:
  /// \param T_sim_object  on the ground under its middle, x to its front, levelled
  /// \param half_size     of its outline, m along x and y
  SpiralPath(const SpiralConfig& config, const SE3& T_sim_object, const Eigen::Vector2d& half_size,
             core::Rng& rng);

  /// T_sim_lidar at `t` seconds after the start; any t is allowed.
  [[nodiscard]] SE3 pose(double t) const;

 private:
  [[nodiscard]] double gap(double t) const;
  [[nodiscard]] double bearing(double t) const;
  [[nodiscard]] double highest_at(double range) const;
  [[nodiscard]] Eigen::Vector3d position(double t) const;

  SpiralConfig config_;
  SE3 T_sim_object_;
  Eigen::Vector2d half_size_;
  double first_gap_, last_gap_;
  double speed_;
  double way_;            ///< +1: counter-clockwise from above
  double first_bearing_;  ///< rad, in the object's frame
  double softening_;      ///< m: bounds the rate of turning near the object
  double middle_height_;  ///< share of the way from the lowest to the highest
  Swing rise_, look_, roll_, pitch_;
};

}  // namespace saker::simulation
