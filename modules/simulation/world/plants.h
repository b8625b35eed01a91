#pragma once

#include <vector>

#include "saker/simulation/world/palette.h"

namespace saker::simulation {

/// The crowns and bushes of one world: clouds of leaves, each drawn once and placed many times at
/// other sizes and turns.
struct Flora {
  std::vector<std::size_t> crowns;  ///< prototypes: unit radius, unit height, from z = 0
  std::vector<std::size_t> conifers;
  std::vector<std::size_t> bushes;
  std::vector<std::size_t> hedges;  ///< unit blocks: x ±0.5, y ±0.5, z 0 … 1
};

[[nodiscard]] Flora grow_flora(World& world, const Palette& palette, core::Rng& rng);

struct TreeShape {
  double trunk_radius = 0.15;  ///< at breast height
  double crown_start = 2.5;    ///< height of the lowest leaves
  double crown_radius = 2.2;
  double crown_height = 4;
  double lean_x = 0, lean_y = 0;  ///< sideways shift per metre of height
  bool conifer = false;
  bool bare = false;  ///< branches only
};

[[nodiscard]] TreeShape random_tree(core::Rng& rng);

/// A tree rooted at the origin of `T_world_ground`, with its trunk in the world's truth where a
/// metre of it or more stands free under the crown.
void add_tree(World& world, const Palette& palette, const Flora& flora, const TreeShape& shape,
              const SE3& T_world_ground, core::Rng& rng);

/// A bush from the ground up: `radius` wide, `height` high.
void add_bush(World& world, const Flora& flora, const SE3& T_world_ground, double radius,
              double height, core::Rng& rng);

/// A block of hedge along x from the origin.
void add_hedge_block(World& world, const Flora& flora, const SE3& T_world_ground, double length,
                     double depth, double height, core::Rng& rng);

}  // namespace saker::simulation
