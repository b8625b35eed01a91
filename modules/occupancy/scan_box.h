#pragma once

#include <octomap/octomap.h>

#include <cstdint>
#include <span>
#include <vector>

namespace saker::occupancy {

/// What a scan says of a cell. As bits: of a cube of cells the sum is what it says of any of them.
enum Seen : std::uint8_t { kUnseen = 0, kFree = 1, kOccupied = 2 };

/// A cube of leaves of the octree: its lowest keys and its edge, a power of two.
struct KeyCube {
  int x = 0, y = 0, z = 0;
  int edge = 0;

  /// Its eighths, in OctoMap's order of children.
  [[nodiscard]] KeyCube child(int index) const {
    const int half = edge / 2;
    return {x + (index & 1) * half, y + (index >> 1 & 1) * half, z + (index >> 2) * half, half};
  }
};

/// The cells that one scan sees, in a dense box around its origin.
///
/// The same sets as OctoMap's OccupancyOcTreeBase::computeUpdate, without hashing: each ray goes
/// through the box by Amanatides and Woo's traversal, four rays side by side, with OctoMap's
/// arithmetic step by step. Cost: a byte a cell, some 2 ns a cell of a ray.
class ScanBox {
 public:
  ScanBox(double resolution_m, double range_m);

  /// Whether the box around this origin lies within the keys of the tree.
  [[nodiscard]] bool fits(const octomap::OcTree& tree, const octomap::point3d& origin) const;

  /// Where a beam leads.
  struct Beam {
    octomap::point3d end;  ///< finite, in the tree's frame
    float from_m = 0;      ///< range from which on it clears
  };

  /// Forgets the last scan and takes this one. An end beyond the range only clears, up to it.
  /// \param tree gives the lattice alone
  /// \param origin one that fits
  void collect(const octomap::OcTree& tree, const octomap::point3d& origin,
               std::span<const Beam> beams);

  /// Bits of what was seen in a cube of the tree.
  [[nodiscard]] std::uint8_t seen(const KeyCube& cube) const;

 private:
  struct Rays;

  /// Where rays begin.
  struct Start {
    octomap::point3d point;
    octomap::OcTreeKey key;
    double wall[3][2] = {};  ///< m: its cell's lower and upper wall along each axis
  };

  void begin(const octomap::OcTree& tree, const octomap::point3d& origin);
  [[nodiscard]] Start start_at(const octomap::OcTree& tree, const octomap::point3d& point) const;
  void aim(const octomap::OcTree& tree, const Start& start, const octomap::point3d& end,
           Rays& rays);
  void march(Rays& rays);
  void summarise();
  [[nodiscard]] int index_of(const octomap::OcTreeKey& key) const;

  double resolution_m_;
  double range_m_;
  int half_;  // cells from the origin's to the box's border, at least
  int edge_;  // cells, a multiple of a brick's
  octomap::OcTreeKey corner_;
  Start origin_;
  std::vector<std::uint8_t> cells_;   // x fastest
  std::vector<std::uint8_t> bricks_;  // bits of all their cells
  std::vector<int> hits_;
};

}  // namespace saker::occupancy
