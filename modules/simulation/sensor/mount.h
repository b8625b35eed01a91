#pragma once

#include <string>
#include <vector>

#include "saker/simulation/world/world_builder.h"

/// What carries the sensor of a training scan, and how it moves meanwhile.
///
/// Makes: poses of a sensor over one revolution and the carrier's own body, which hides the world.
/// Frames: `sim`, z up; vehicle: x forward, z up, on the ground below the sensor. Units: m, s, rad.
namespace saker::simulation {

enum class MountKind { car, truck, robot, hand, air };

[[nodiscard]] const char* name_of(MountKind kind);

/// A part of the carrier, in the vehicle frame.
struct BodyBox {
  Eigen::Vector3d low;
  Eigen::Vector3d high;
};

struct Mount {
  MountKind kind = MountKind::car;
  SE3 T_world_vehicle = SE3::Identity();  ///< in the middle of the revolution
  SE3 T_vehicle_lidar = SE3::Identity();
  Vector6d twist =
      Vector6d::Zero();  ///< of the vehicle in its frame: rotation, translation; a second
  double height_m = 0;   ///< of the sensor over the ground
  std::vector<BodyBox> body;

  [[nodiscard]] double speed_mps() const { return twist.tail<3>().norm(); }
  /// T_world_lidar `t` seconds after the middle of the revolution.
  [[nodiscard]] SE3 pose(double t) const;
};

/// A random carrier on a free place of the world.
[[nodiscard]] Mount any_mount(const BuiltWorld& built, core::Rng& rng);

/// Distance along a ray to the body, or infinity; origin and direction in the vehicle frame.
[[nodiscard]] double distance_to_body(const std::vector<BodyBox>& body,
                                      const Eigen::Vector3d& origin,
                                      const Eigen::Vector3d& direction);

}  // namespace saker::simulation
