#include "saker/motion/destination.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace saker::motion {
namespace {

using occupancy::OccupancyGrid;

constexpr int kBetweenLooks = 4096;  // cells between looks at the clock: under a millisecond

Eigen::Vector3i cell_at(const OccupancyGrid& grid, int offset) {
  const int in_layer = offset % (grid.size.x() * grid.size.y());
  return {in_layer % grid.size.x(), in_layer / grid.size.x(),
          offset / (grid.size.x() * grid.size.y())};
}

template <class Visit>
void for_each_cell(const Eigen::Vector3i& first, const Eigen::Vector3i& last, Visit visit) {
  for (int z = first.z(); z <= last.z(); ++z)
    for (int y = first.y(); y <= last.y(); ++y)
      for (int x = first.x(); x <= last.x(); ++x) visit(Eigen::Vector3i(x, y, z));
}

/// Dijkstra's wave through cells that may be free.
class Wave {
 public:
  Wave(const FreeSpace& space, const std::vector<int>& reached)
      : space_(space),
        grid_(space.grid()),
        occupied_(space.occupied_field()),
        reached_(grid_.cells.size(), 0),
        cost_(grid_.cells.size(), std::numeric_limits<float>::infinity()) {
    for (const int offset : reached) reached_[static_cast<std::size_t>(offset)] = 1;
  }

  /// \return whether there is a cell to start from
  bool start_near(const Eigen::Vector3d& goal, double tolerance_m) {
    const Eigen::Vector3d reach = Eigen::Vector3d::Constant(tolerance_m);
    const Eigen::Vector3i top = grid_.size - Eigen::Vector3i::Ones();
    for_each_cell(grid_.index_of(goal - reach).cwiseMax(0),
                  grid_.index_of(goal + reach).cwiseMin(top), [&](const Eigen::Vector3i& cell) {
                    const double cost = (grid_.centre_of(cell) - goal).norm();
                    if (cost <= tolerance_m) offer(cell, cost);
                  });
    return !queue_.empty();
  }

  bool start_on_faces(const Eigen::Vector3d& goal) {
    const Eigen::Vector3i top = grid_.size - Eigen::Vector3i::Ones();
    for_each_cell(Eigen::Vector3i::Zero(), top, [&](const Eigen::Vector3i& cell) {
      const bool on_face = (cell.array() == 0).any() || (cell.array() == top.array()).any();
      if (on_face) offer(cell, (grid_.centre_of(cell) - goal).norm());
    });
    return !queue_.empty();
  }

  /// The first reached cell that it meets; none: `enclosed`.
  Destination meet_reached(const core::Budget& budget) {
    for (int pops = 0; !queue_.empty(); ++pops) {
      if (pops % kBetweenLooks == 0 && budget.seconds_left() <= 0) return {};
      const auto [cost, offset] = queue_.top();
      queue_.pop();
      if (cost > cost_[static_cast<std::size_t>(offset)]) continue;
      const Eigen::Vector3i cell = cell_at(grid_, offset);
      if (reached_[static_cast<std::size_t>(offset)] != 0)
        return {DestinationKind::on_the_way, grid_.centre_of(cell)};
      spread(cell, cost);
    }
    return {DestinationKind::enclosed, {}};
  }

 private:
  void offer(const Eigen::Vector3i& cell, double cost) {
    const std::size_t offset = grid_.offset(cell);
    if (static_cast<float>(cost) >= cost_[offset]) return;
    if (!space_.cell_may_be_free(cell, occupied_)) return;
    cost_[offset] = static_cast<float>(cost);
    queue_.emplace(static_cast<float>(cost), static_cast<int>(offset));
  }

  void spread(const Eigen::Vector3i& cell, float cost) {
    const Eigen::Vector3i one = Eigen::Vector3i::Ones();
    for_each_cell(cell - one, cell + one, [&](const Eigen::Vector3i& next) {
      if (!grid_.contains(next)) return;
      offer(next, cost + grid_.resolution_m * (next - cell).cast<double>().norm());
    });
  }

  const FreeSpace& space_;
  const OccupancyGrid& grid_;
  occupancy::DistanceField occupied_;
  std::vector<std::uint8_t> reached_;
  std::vector<float> cost_;  // m, to the goal
  std::priority_queue<std::pair<float, int>, std::vector<std::pair<float, int>>, std::greater<>>
      queue_;
};

}  // namespace

std::vector<int> reachable_cells(const FreeSpace& space, const Eigen::Vector3d& start,
                                 const core::Budget& budget) {
  const OccupancyGrid& grid = space.grid();
  std::vector<int> reached;  // those before `next` have been looked around
  std::vector<std::uint8_t> seen(grid.cells.size(), 0);
  const auto reach = [&](const Eigen::Vector3i& cell) {
    if (!grid.contains(cell)) return;
    const std::size_t offset = grid.offset(cell);
    if (seen[offset] != 0) return;
    seen[offset] = 1;
    if (space.cell_free(cell)) reached.push_back(static_cast<int>(offset));
  };

  const Eigen::Vector3i one = Eigen::Vector3i::Ones();
  const Eigen::Vector3i home = grid.index_of(start);
  for_each_cell(home - one, home + one, [&](const Eigen::Vector3i& cell) {
    if (grid.contains(cell) && space.free(start, grid.centre_of(cell))) reach(cell);
  });
  for (std::size_t next = 0; next < reached.size(); ++next) {
    if (next % kBetweenLooks == 0 && budget.seconds_left() <= 0) break;
    const Eigen::Vector3i cell = cell_at(grid, reached[next]);
    for (int axis = 0; axis < 3; ++axis) {
      reach(cell + Eigen::Vector3i::Unit(axis));
      reach(cell - Eigen::Vector3i::Unit(axis));
    }
  }
  return reached;
}

Destination find_destination(const FreeSpace& space, const std::vector<int>& reached,
                             const Eigen::Vector3d& goal, double tolerance_m,
                             const core::Budget& budget) {
  const OccupancyGrid& grid = space.grid();
  Wave wave(space, reached);
  if (grid.contains(grid.index_of(goal))) {
    if (!wave.start_near(goal, grid.resolution_m) && !wave.start_near(goal, tolerance_m))
      return {DestinationKind::blocked, {}};
  } else if (!wave.start_on_faces(goal)) {
    return {DestinationKind::enclosed, {}};
  }
  Destination found = wave.meet_reached(budget);
  if (found.kind != DestinationKind::on_the_way) return found;
  const bool at_goal = (found.point - goal).norm() <= tolerance_m;
  if (at_goal) found.kind = DestinationKind::goal;
  if (at_goal && space.free(found.point, goal)) found.point = goal;
  return found;
}

}  // namespace saker::motion
