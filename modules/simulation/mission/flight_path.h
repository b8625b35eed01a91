#pragma once

#include "saker/simulation/mission/given_path.h"
#include "saker/simulation/mission/scenario.h"
#include "saker/simulation/world/terrain.h"

namespace saker::simulation {

/// Where a multirotor's LiDAR is at any time: a smooth flight along the street that begins and ends
/// hovering. The vehicle leans into its acceleration and shakes a little.
class FlightPath {
 public:
  FlightPath(const FlightConfig& config, const Terrain& terrain, core::Rng& rng);

  /// T_sim_lidar at `t` seconds after the start; any t is allowed.
  [[nodiscard]] SE3 pose(double t) const;

 private:
  [[nodiscard]] double travelled(double t) const;
  [[nodiscard]] double envelope(double t) const;
  [[nodiscard]] Eigen::Vector3d position(double t) const;
  [[nodiscard]] double heading(double t) const;

  FlightConfig config_;
  const Terrain* terrain_;
  double start_s_;
  double base_z_;
  Swing sway_, rise_, look_;
  Swing roll_, pitch_;
};

}  // namespace saker::simulation
