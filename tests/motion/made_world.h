#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "saker/core/rng.h"
#include "saker/motion/motion.h"

/// Worlds of boxes and upright cylinders, whose distances are known exactly, and their snapshots.
namespace saker::motion::made {

using occupancy::Cell;
using occupancy::OccupancyGrid;

struct Box {
  Eigen::Vector3d low, high;
  [[nodiscard]] double distance_m(const Eigen::Vector3d& p) const {
    return (low - p).cwiseMax(p - high).cwiseMax(0).norm();
  }
};

struct Cylinder {
  Eigen::Vector2d centre;
  double radius_m;
  [[nodiscard]] double distance_m(const Eigen::Vector3d& p) const {
    return std::max(0.0, (p.head<2>() - centre).norm() - radius_m);
  }
};

/// A block that is free until something is put into it. A cell that something reaches is occupied.
class World {
 public:
  World(const Eigen::Vector3d& low, const Eigen::Vector3d& high, double resolution_m = 0.25) {
    grid_.resolution_m = resolution_m;
    grid_.origin = low;
    grid_.size = ((high - low) / resolution_m).array().round().cast<int>();
    grid_.cells.assign(static_cast<std::size_t>(grid_.size.prod()), Cell::free);
  }

  World& add(const Box& box) {
    boxes_.push_back(box);
    return mark(box.low, box.high, [&](const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
      return (low.array() < box.high.array()).all() && (high.array() > box.low.array()).all();
    });
  }

  World& add(const Cylinder& c) {
    cylinders_.push_back(c);
    const Eigen::Vector3d side(c.radius_m, c.radius_m, 1e3), axis(c.centre.x(), c.centre.y(), 0);
    return mark(
        axis - side, axis + side, [&](const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
          const Eigen::Vector2d nearest = c.centre.cwiseMax(low.head<2>()).cwiseMin(high.head<2>());
          return (nearest - c.centre).norm() < c.radius_m;
        });
  }

  /// What was not seen: the free cells with their centres in the box.
  World& hide(const Box& box) {
    for (int i = 0; i < grid_.size.prod(); ++i) {
      Cell& cell = grid_.cells[static_cast<std::size_t>(i)];
      if (cell == Cell::free && box.distance_m(centre(i)) == 0) cell = Cell::unknown;
    }
    return *this;
  }

  /// Exact, to what was put into it.
  [[nodiscard]] double distance_m(const Eigen::Vector3d& p) const {
    double nearest = INFINITY;
    for (const Box& box : boxes_) nearest = std::min(nearest, box.distance_m(p));
    for (const Cylinder& c : cylinders_) nearest = std::min(nearest, c.distance_m(p));
    return nearest;
  }

  [[nodiscard]] std::shared_ptr<const OccupancyGrid> grid() const {
    return std::make_shared<OccupancyGrid>(grid_);
  }

 private:
  [[nodiscard]] Eigen::Vector3d centre(int i) const {
    const int layer = grid_.size.x() * grid_.size.y();
    return grid_.centre_of({i % grid_.size.x(), i % layer / grid_.size.x(), i / layer});
  }
  /// Of the cells around the box, those that the object touches.
  template <class Touches>
  World& mark(const Eigen::Vector3d& low, const Eigen::Vector3d& high, Touches touches) {
    const Eigen::Vector3d half = Eigen::Vector3d::Constant(0.5 * grid_.resolution_m);
    const Eigen::Vector3i first = grid_.index_of(low).cwiseMax(0);
    const Eigen::Vector3i last =
        grid_.index_of(high).cwiseMin(grid_.size - Eigen::Vector3i::Ones());
    for (int z = first.z(); z <= last.z(); ++z)
      for (int y = first.y(); y <= last.y(); ++y)
        for (int x = first.x(); x <= last.x(); ++x) {
          const Eigen::Vector3d p = grid_.centre_of({x, y, z});
          if (touches(p - half, p + half)) grid_.cells[grid_.offset({x, y, z})] = Cell::occupied;
        }
    return *this;
  }

  OccupancyGrid grid_;
  std::vector<Box> boxes_;
  std::vector<Cylinder> cylinders_;
};

/// 40 × 40 × 10 m with `count` trunks of 10 to 50 cm radius, none within 2 m of the corners that
/// `start` and `goal` of the flights through it lie in.
inline World forest(std::uint64_t seed, int count) {
  World world({-20, -20, 0}, {20, 20, 10});
  core::Rng rng(seed);
  for (int placed = 0; placed < count;) {
    const double x = rng.uniform(-19, 19), y = rng.uniform(-19, 19);
    const Eigen::Vector2d p(x, y);
    if ((p.cwiseAbs() - Eigen::Vector2d(17, 17)).norm() < 2.5) continue;
    world.add(Cylinder{p, rng.uniform(0.1, 0.5)});
    ++placed;
  }
  return world;
}

inline MotionState resting_at(const Eigen::Vector3d& p, double yaw = 0) {
  return {p, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), yaw, 0};
}

inline PlanRequest request(const World& world, const MotionState& start,
                           const Eigen::Vector3d& goal, std::uint64_t seed = 1) {
  PlanRequest r;
  r.start = start;
  r.start_time = from_seconds(100);
  r.goal = goal;
  r.grid = world.grid();
  r.trajectory_id = 7;
  r.seed = seed;
  return r;
}

/// Enough for every world here.
inline core::Budget ample() { return core::Budget::iterations(20'000); }

/// The greatest of something over a trajectory, looked at every 10 ms.
template <class Value>
double greatest(const Trajectory& trajectory, Value value) {
  double most = -INFINITY;
  for (Time t = trajectory.start; t <= trajectory.end(); t += from_seconds(0.01))
    most = std::max(most, value(trajectory.sample(t)));
  return most;
}

}  // namespace saker::motion::made
