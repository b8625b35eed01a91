#pragma once

#include "saker/simulation/world/palette.h"

namespace saker::simulation {

struct BuildingShape {
  double width = 12;  ///< along the street
  double depth = 10;
  double storeys = 3;
  double storey_height = 2.9;
  bool gable = false;  ///< a pitched roof
  bool shop = false;   ///< large panes on the ground floor
  double balcony_share = 0;
};

[[nodiscard]] BuildingShape random_building(core::Rng& rng, bool detached);

/// A building whose front runs along x at y = 0 from x = 0, its body to y > 0, standing a little
/// into the ground.
void add_building(World& world, const Palette& palette, const BuildingShape& shape,
                  const SE3& T_world_corner, core::Rng& rng);

/// Bounds of gardens and roads along x from the origin, in pieces of a few metres.
enum class Fence { wire, picket, wall, rail, panels };
void add_fence(World& world, const Palette& palette, Fence kind, const SE3& T_world_start,
               double length, double height);

}  // namespace saker::simulation
