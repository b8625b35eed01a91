#include "saker/slam/ground_map.h"

#include <algorithm>
#include <cmath>

namespace saker::slam {

using objects::GroundPlane;

void GroundMap::add(const std::vector<GroundPlane>& planes, const Trajectory& trajectory) {
  for (const GroundPlane& plane : planes) {
    if (!plane.normal.allFinite() || !plane.point.allFinite() || !std::isfinite(plane.radius))
      continue;
    const GroundPlane seen = transformed(trajectory.T_world_lidar(), plane);
    const std::pair key(static_cast<int>(std::floor(seen.point.x() / config_.cell_m)),
                        static_cast<int>(std::floor(seen.point.y() / config_.cell_m)));
    fuse(cells_[key], seen, trajectory);
    make_room();
  }
}

void GroundMap::fuse(Cell& cell, const GroundPlane& in_world, const Trajectory& trajectory) {
  GroundPlane mean = in_world;
  if (cell.weight > 0) {
    const GroundPlane before = this->in_world(cell, trajectory);
    const double share = 1.0 / (cell.weight + 1);
    mean.normal = (before.normal + share * (in_world.normal - before.normal)).normalized();
    mean.point = before.point + share * (in_world.point - before.point);
    mean.radius = before.radius + share * (in_world.radius - before.radius);
  }
  cell.keyframe = trajectory.newest().serial;
  cell.weight = std::min(cell.weight + 1, config_.most_weight);
  cell.plane = transformed(trajectory.newest().T_world_lidar.inverse(), mean);
}

void GroundMap::retire(const Keyframe& keyframe) {
  for (auto& [key, cell] : cells_) {
    if (cell.keyframe != keyframe.serial) continue;
    cell.plane = transformed(keyframe.T_world_lidar, cell.plane);
    cell.keyframe = -1;
  }
}

void GroundMap::make_room() {
  if (static_cast<int>(cells_.size()) <= config_.most_cells) return;
  cells_.erase(std::min_element(cells_.begin(), cells_.end(), [](const auto& a, const auto& b) {
    return a.second.keyframe < b.second.keyframe;
  }));
}

GroundPlane GroundMap::in_world(const Cell& cell, const Trajectory& trajectory) const {
  const Keyframe* keyframe = trajectory.find(cell.keyframe);
  return keyframe != nullptr ? transformed(keyframe->T_world_lidar, cell.plane) : cell.plane;
}

std::vector<GroundPlane> GroundMap::planes(const Trajectory& trajectory) const {
  std::vector<GroundPlane> planes;
  for (const auto& [key, cell] : cells_) planes.push_back(in_world(cell, trajectory));
  return planes;
}

}  // namespace saker::slam
