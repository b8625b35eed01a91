#pragma once

#include <octomap/octomap.h>

#include "saker/occupancy/grid.h"
#include "saker/occupancy/scan_box.h"

namespace saker::occupancy {

/// An octomap::OcTree that takes a whole scan in one walk from the root, each node once.
///
/// What OctoMap does key by key from the root ends in the same tree whatever the order: a leaf gets
/// one update a scan, and an inner node is pruned where its eight children are equal leaves.
class MapTree : public octomap::OcTree {
 public:
  explicit MapTree(double resolution_m) : octomap::OcTree(resolution_m) {}

  void update(const ScanBox& box);

  /// Drops what lies wholly beyond `radius_m` of `centre`. \return nodes dropped
  std::size_t drop_beyond(const Eigen::Vector3d& centre, double radius_m);

  /// Cells of the block, `lowest` its lowest keys: within the tree.
  [[nodiscard]] std::vector<Cell> cells(const octomap::OcTreeKey& lowest,
                                        const Eigen::Vector3i& size) const;

 private:
  struct Ball;

  void fetch_children(const octomap::OcTreeNode& node) const;
  void update(octomap::OcTreeNode& node, bool fresh, const KeyCube& cube, const ScanBox& box);
  [[nodiscard]] bool stays(const octomap::OcTreeNode& leaf, std::uint8_t seen) const;
  bool drop(octomap::OcTreeNode& node, const KeyCube& cube, const Ball& keep);
  void make_leaf(octomap::OcTreeNode& node);
  void copy(const octomap::OcTreeNode& node, const KeyCube& cube, const octomap::OcTreeKey& lowest,
            const Eigen::Vector3i& size, std::vector<Cell>& cells) const;
};

}  // namespace saker::occupancy
