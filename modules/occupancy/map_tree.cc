#include "saker/occupancy/map_tree.h"

#include <algorithm>

namespace saker::occupancy {
namespace {

constexpr int kKeys = 1 << 16;  // along an axis of the tree
constexpr KeyCube kWhole{0, 0, 0, kKeys};
constexpr unsigned kChildren = 8;

}  // namespace

/// OctoMap's nodes lie all over memory: fetched together, a node's children wait for each other's.
void MapTree::fetch_children(const octomap::OcTreeNode& node) const {
  for (unsigned i = 0; i < kChildren; ++i)
    if (nodeChildExists(&node, i)) __builtin_prefetch(getNodeChild(&node, i));
}

void MapTree::update(const ScanBox& box) {
  if (box.seen(kWhole) == kUnseen) return;
  const bool fresh = root == nullptr;
  if (fresh) {
    root = new octomap::OcTreeNode();
    ++tree_size;
  }
  update(*root, fresh, kWhole, box);
}

/// As OctoMap's updateNodeRecurs, for all keys of a cube.
void MapTree::update(octomap::OcTreeNode& node, bool fresh, const KeyCube& cube,
                     const ScanBox& box) {
  const std::uint8_t seen = box.seen(cube);
  if (cube.edge == 1) {
    const float log_odds = node.getLogOdds() + (seen == kOccupied ? prob_hit_log : prob_miss_log);
    node.setLogOdds(std::clamp(log_odds, clamping_thres_min, clamping_thres_max));
    return;
  }
  if (!fresh && !nodeHasChildren(&node)) {
    if (stays(node, seen)) return;
    expandNode(&node);
  }
  if (nodeHasChildren(&node)) fetch_children(node);
  for (unsigned i = 0; i < kChildren; ++i) {
    const KeyCube child = cube.child(static_cast<int>(i));
    if (box.seen(child) == kUnseen) continue;
    const bool exists = nodeChildExists(&node, i);
    update(*(exists ? getNodeChild(&node, i) : createNodeChild(&node, i)), !exists, child, box);
  }
  if (!pruneNode(&node)) node.updateOccupancyChildren();
}

/// Whether a leaf already is as free, or as occupied, as it can become by what was seen in it.
bool MapTree::stays(const octomap::OcTreeNode& leaf, std::uint8_t seen) const {
  return (seen == kFree && leaf.getLogOdds() <= clamping_thres_min) ||
         (seen == kOccupied && leaf.getLogOdds() >= clamping_thres_max);
}

/// In keys.
struct MapTree::Ball {
  Eigen::Vector3d centre;
  double radius;

  [[nodiscard]] bool contains(const KeyCube& cube) const { return farthest(cube) <= radius; }
  [[nodiscard]] bool misses(const KeyCube& cube) const {
    return outside(cube).cwiseMax(0).norm() > radius;
  }

 private:
  [[nodiscard]] Eigen::Vector3d middle(const KeyCube& cube) const {
    return Eigen::Vector3d(cube.x, cube.y, cube.z).array() + 0.5 * cube.edge;
  }
  [[nodiscard]] Eigen::Vector3d outside(const KeyCube& cube) const {
    return (middle(cube) - centre).cwiseAbs().array() - 0.5 * cube.edge;
  }
  [[nodiscard]] double farthest(const KeyCube& cube) const {
    return ((middle(cube) - centre).cwiseAbs().array() + 0.5 * cube.edge).matrix().norm();
  }
};

std::size_t MapTree::drop_beyond(const Eigen::Vector3d& centre, double radius_m) {
  if (root == nullptr) return 0;
  const std::size_t before = tree_size;
  const Ball keep{(centre.array() / resolution + kKeys / 2).matrix(), radius_m / resolution};
  if (drop(*root, kWhole, keep)) clear();
  return before - tree_size;
}

/// \return whether the node holds nothing that is kept: it is a leaf then.
bool MapTree::drop(octomap::OcTreeNode& node, const KeyCube& cube, const Ball& keep) {
  if (keep.contains(cube)) return false;
  if (keep.misses(cube)) {
    make_leaf(node);
    return true;
  }
  if (!nodeHasChildren(&node)) return false;
  for (unsigned i = 0; i < kChildren; ++i)
    if (nodeChildExists(&node, i) &&
        drop(*getNodeChild(&node, i), cube.child(static_cast<int>(i)), keep))
      deleteNodeChild(&node, i);
  if (nodeHasChildren(&node)) {
    node.updateOccupancyChildren();
    return false;
  }
  createNodeChild(&node, 0);
  make_leaf(node);
  return true;
}

/// OctoMap frees a node's table of children only where it prunes: when all eight are equal leaves.
void MapTree::make_leaf(octomap::OcTreeNode& node) {
  if (!nodeHasChildren(&node)) return;
  for (unsigned i = 0; i < kChildren; ++i) {
    octomap::OcTreeNode& child =
        *(nodeChildExists(&node, i) ? getNodeChild(&node, i) : createNodeChild(&node, i));
    make_leaf(child);
    child.copyData(node);
  }
  pruneNode(&node);
}

std::vector<Cell> MapTree::cells(const octomap::OcTreeKey& lowest,
                                 const Eigen::Vector3i& size) const {
  std::vector<Cell> cells(static_cast<std::size_t>(size.x()) * size.y() * size.z(), Cell::unknown);
  if (root != nullptr) copy(*root, kWhole, lowest, size, cells);
  return cells;
}

void MapTree::copy(const octomap::OcTreeNode& node, const KeyCube& cube,
                   const octomap::OcTreeKey& lowest, const Eigen::Vector3i& size,
                   std::vector<Cell>& cells) const {
  const Eigen::Vector3i corner(cube.x - lowest[0], cube.y - lowest[1], cube.z - lowest[2]);
  const Eigen::Vector3i low = corner.cwiseMax(0);
  const Eigen::Vector3i high = (corner.array() + cube.edge).matrix().cwiseMin(size);
  if ((low.array() >= high.array()).any()) return;
  if (nodeHasChildren(&node)) {
    fetch_children(node);
    for (unsigned i = 0; i < kChildren; ++i)
      if (nodeChildExists(&node, i))
        copy(*getNodeChild(&node, i), cube.child(static_cast<int>(i)), lowest, size, cells);
    return;
  }
  const Cell value = isNodeOccupied(&node) ? Cell::occupied : Cell::free;
  for (int z = low.z(); z < high.z(); ++z)
    for (int y = low.y(); y < high.y(); ++y)
      std::fill_n(&cells[(static_cast<std::size_t>(z) * size.y() + y) * size.x() + low.x()],
                  high.x() - low.x(), value);
}

}  // namespace saker::occupancy
