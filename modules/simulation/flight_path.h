#pragma once

#include <vector>

#include "lidar/scan.h"
#include "simulation/scenario.h"
#include "simulation/terrain.h"

namespace saker::simulation {

/// Where a multirotor's LiDAR is at any time: a smooth flight along the street that begins and ends
/// hovering. The vehicle leans into its acceleration and shakes a little. Analytic, so that every
/// derivative exists.
class FlightPath {
 public:
  FlightPath(const FlightConfig& config, const Terrain& terrain, core::Rng& rng);

  /// T_sim_lidar at `t` seconds after the start; any t is allowed.
  [[nodiscard]] SE3 pose(double t) const;

 private:
  struct Swing {
    double amplitude, period, phase;
    [[nodiscard]] double at(double t) const;
  };

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

/// What an inertial unit at `T_lidar_imu` of the sensor reads along the path: specific force and
/// turn rate in the lidar frame's axes, with noise and a constant bias.
[[nodiscard]] std::vector<lidar::ImuSample> simulate_imu(const FlightPath& path,
                                                         const ImuConfig& config,
                                                         const SE3& T_lidar_imu, double duration_s,
                                                         Time start, core::Rng& rng);

}  // namespace saker::simulation
