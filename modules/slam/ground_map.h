#pragma once

#include <map>
#include <utility>
#include <vector>

#include "saker/core/config.h"
#include "saker/objects/models.h"
#include "saker/slam/trajectory.h"

namespace saker::slam {

struct GroundMapConfig {
  double cell_m = 5;
  int most_cells = 4000;
  int most_weight = 20;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("cell_m", cell_m, {0.5, 100}, "m",
            "edge of a cell in x-y, one plane each: local ground of a vehicle's length");
    v.field("most_cells", most_cells, {1, 1000000}, "",
            "cells kept; the one not seen for longest goes first");
    v.field("most_weight", most_weight, {1, 1000}, "",
            "measurements that a cell's plane remembers");
  }
};

/// Local ground planes, fused on a grid. Each cell's plane hangs on the keyframe from which it was
/// last seen, and so follows the trajectory when that is corrected.
class GroundMap {
 public:
  explicit GroundMap(const GroundMapConfig& config) : config_(config) {}

  /// \param planes in the lidar frame; those that are not finite are skipped.
  void add(const std::vector<objects::GroundPlane>& planes, const Trajectory& trajectory);

  /// What hangs on this keyframe stays where it is now.
  void retire(const Keyframe& keyframe);

  [[nodiscard]] std::vector<objects::GroundPlane> planes(const Trajectory& trajectory) const;

 private:
  struct Cell {
    int keyframe = 0;  ///< serial; −1: retired, the plane is in the world frame
    int weight = 0;
    objects::GroundPlane plane;  ///< in the keyframe's lidar frame
  };

  void fuse(Cell& cell, const objects::GroundPlane& in_world, const Trajectory& trajectory);
  void make_room();
  [[nodiscard]] objects::GroundPlane in_world(const Cell& cell, const Trajectory& trajectory) const;

  GroundMapConfig config_;
  std::map<std::pair<int, int>, Cell> cells_;
};

}  // namespace saker::slam
