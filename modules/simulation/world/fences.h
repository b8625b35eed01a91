#pragma once

#include "saker/simulation/world/street_palette.h"

namespace saker::simulation {

/// What bounds lots and roads in training's streets. Jersey barriers and retaining walls are other
/// structures, the rest is fence.
enum class Boundary {
  chain_link,
  picket,
  iron_railing,
  panels,
  slats,
  stone_wall,
  wall_with_railing,
  balustrade,
  guard_rail,
  site_fence,
  hoarding,
  jersey,
  post_and_rail,
  bars,
};
constexpr int kBoundaries = 14;

[[nodiscard]] Boundary any_boundary(core::Rng& rng);

/// One piece along x from the origin, its foot on the ground.
void add_boundary(World& world, const StreetPalette& palette, Boundary kind,
                  const SE3& T_world_start, double length, double height);

/// A gate between two pillars, along x from the origin.
void add_gate(World& world, const StreetPalette& palette, const SE3& T_world_start, double width,
              core::Rng& rng);

}  // namespace saker::simulation
