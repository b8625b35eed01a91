#pragma once

#include <memory>

#include "../occupancy/made_scan.h"
#include "flight/bus/messages.h"
#include "flight/bus/scan_messages.h"

/// A hall that a vehicle hovers in, as messages: every beam comes back.
namespace saker::made {

inline BoxWorld hall(bool with_pillar) {
  constexpr double kWall = 0.5;
  const Box inside(Eigen::Vector3d(-10, -8, 0), Eigen::Vector3d(20, 8, 6));
  BoxWorld world;
  for (int axis = 0; axis < 3; ++axis) {
    Box low = inside, high = inside;
    low.max()[axis] = inside.min()[axis];
    low.min()[axis] = inside.min()[axis] - kWall;
    high.min()[axis] = inside.max()[axis];
    high.max()[axis] = inside.max()[axis] + kWall;
    world.boxes.push_back(low);
    world.boxes.push_back(high);
  }
  if (with_pillar)
    world.boxes.emplace_back(Eigen::Vector3d(6, -0.4, 0), Eigen::Vector3d(6.5, 0.4, 6));
  return world;
}

/// As the vehicle sees it from the start of `along_the_hall`.
inline autonomy::RegisteredScan hall_scan(Time stamp, bool with_pillar, core::Rng& rng) {
  Beams beams;
  beams.half_opening = 0.75;
  const SE3 T = pose({0.1, 0.1, 3.1}, 0.1);
  return {
      stamp, T,
      std::make_shared<const std::vector<Eigen::Vector3f>>(scan(hall(with_pillar), T, beams, rng))};
}

/// 10 m along x at 2 m/s.
inline motion::Trajectory along_the_hall(std::int64_t id, Time start) {
  motion::Trajectory trajectory;
  trajectory.id = id;
  trajectory.start = start;
  trajectory.step_s = 0.5;
  for (int i = 0; i <= 10; ++i) {
    motion::MotionState state;
    state.position = {1.0 * i, 0.1, 2.9};
    state.velocity = {i < 10 ? 2.0 : 0.0, 0, 0};
    state.acceleration = Eigen::Vector3d::Zero();
    state.yaw = 0;
    state.yaw_rate = 0;
    trajectory.states.push_back(state);
  }
  return trajectory;
}

}  // namespace saker::made
