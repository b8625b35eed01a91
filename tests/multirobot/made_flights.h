#pragma once

#include <algorithm>
#include <vector>

#include "../slam/made_world.h"
#include "saker/multirobot/merge.h"

/// Flights of the made world's robot as others hear of them.
namespace saker::slam::made {

/// What a flight leaves: its history, its own map, and the truth.
struct Flown {
  History history;
  objects::ObjectMap map;  ///< in odom at the first pose
  SE3 T_town_odom = SE3::Identity();
  std::vector<SE3> truth;  ///< of each entry, in the town

  [[nodiscard]] objects::ObjectMap in_town() const {
    objects::ObjectMap result = map;
    for (auto& object : result.objects)
      object.model = objects::transformed(T_town_odom, object.model);
    return result;
  }
};

/// Each flight of a seed is another robot's.
inline Flown fly(const std::vector<TrueObject>& world, const std::vector<SE3>& poses,
                 const Noise& noise, std::uint64_t seed, double range = 15, int iterations = 2) {
  Slam slam(honest_config(), {});
  Robot robot(world, noise, seed);
  robot.range = range;
  std::vector<SE3> truth;
  double seconds = 0;
  for (const SE3& pose : poses) {
    const SlamInput input = robot.step(seconds += 0.5, pose);
    if (slam.update(input, core::Budget::iterations(iterations)).keyframe_added)
      truth.push_back(pose);
  }
  Flown flown{slam.history(), slam.map(), poses.front(), truth};
  flown.history.robot = std::to_string(seed);
  flown.history.flight = 1;
  flown.truth.resize(flown.history.entries.size());
  return flown;
}

inline std::vector<SE3> back(std::vector<SE3> poses) {
  std::ranges::reverse(poses);
  return poses;
}

/// Mean distance of a merged trajectory from the truth, m, and that of its end.
inline double path_error(const multirobot::MergedFlight& flight, const Flown& flown) {
  double sum = 0;
  for (std::size_t k = 0; k < flown.truth.size(); ++k)
    sum += (flight.keyframes[k].T_world_lidar.translation() - flown.truth[k].translation()).norm();
  return sum / static_cast<double>(flown.truth.size());
}
inline double end_error(const multirobot::MergedFlight& flight, const Flown& flown) {
  return (flight.keyframes[flown.truth.size() - 1].T_world_lidar.translation() -
          flown.truth.back().translation())
      .norm();
}

}  // namespace saker::slam::made
