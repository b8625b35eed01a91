#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "saker/core/rng.h"
#include "saker/core/se3.h"

/// A world of boxes on a level ground, and the scans that a sensor of 64 beams makes of it.
namespace saker::made {

using Box = Eigen::AlignedBox3d;

struct BoxWorld {
  std::vector<Box> boxes;
  bool ground = true;  ///< at z = 0
};

/// A yard: a wall, a row of parked vans, posts.
inline BoxWorld yard() {
  BoxWorld world;
  world.boxes.emplace_back(Eigen::Vector3d(12, -30, 0), Eigen::Vector3d(12.4, 30, 6));
  for (int i = -3; i < 4; ++i) {
    world.boxes.emplace_back(Eigen::Vector3d(6 * i - 2, 5, 0), Eigen::Vector3d(6 * i + 2, 7, 2.2));
    world.boxes.emplace_back(Eigen::Vector3d(5 * i, -8, 0), Eigen::Vector3d(5 * i + 0.3, -7.7, 7));
  }
  return world;
}

/// How far a ray goes to the box; infinite where it misses.
inline double distance_along(const Box& box, const Eigen::Vector3d& origin,
                             const Eigen::Vector3d& direction) {
  const Eigen::Array3d a = (box.min() - origin).array() / direction.array();
  const Eigen::Array3d b = (box.max() - origin).array() / direction.array();
  const double enter = a.min(b).maxCoeff(), leave = a.max(b).minCoeff();
  return enter <= leave && enter > 0 ? enter : std::numeric_limits<double>::infinity();
}

inline double distance_along(const BoxWorld& world, const Eigen::Vector3d& origin,
                             const Eigen::Vector3d& direction) {
  double nearest = std::numeric_limits<double>::infinity();
  if (world.ground && direction.z() < 0) nearest = -origin.z() / direction.z();
  for (const Box& box : world.boxes)
    nearest = std::min(nearest, distance_along(box, origin, direction));
  return nearest;
}

struct Beams {
  int rows = 64;
  int columns = 1024;
  double half_opening = 22.5 * std::numbers::pi / 180;
  double reach_m = 100;  ///< NaN beyond it
  double noise_m = 0.01;
};

/// Points in the lidar's frame, row by row, each beam a little off its place.
inline std::vector<Eigen::Vector3f> scan(const BoxWorld& world, const SE3& T_world_lidar,
                                         const Beams& beams, core::Rng& rng) {
  std::vector<Eigen::Vector3f> points;
  points.reserve(static_cast<std::size_t>(beams.rows) * beams.columns);
  for (int row = 0; row < beams.rows; ++row)
    for (int column = 0; column < beams.columns; ++column) {
      const double up =
          beams.half_opening * (1 - 2.0 * row / (beams.rows - 1)) + rng.uniform(-1e-3, 1e-3);
      const double around =
          2 * std::numbers::pi * column / beams.columns + rng.uniform(-1e-3, 1e-3);
      const Eigen::Vector3d beam(std::cos(up) * std::cos(around), std::cos(up) * std::sin(around),
                                 std::sin(up));
      const double range =
          distance_along(world, T_world_lidar.translation(), T_world_lidar.rotation() * beam) +
          rng.normal(0, beams.noise_m);
      points.push_back(range < beams.reach_m
                           ? Eigen::Vector3f((range * beam).cast<float>())
                           : Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN()));
    }
  return points;
}

/// At a place, turned and a little tilted.
inline SE3 pose(const Eigen::Vector3d& place, double yaw, double tilt = 0) {
  return Eigen::Translation3d(place) * Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(tilt, Eigen::Vector3d::UnitY());
}

}  // namespace saker::made
