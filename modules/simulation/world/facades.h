#pragma once

#include "saker/simulation/world/buildings.h"
#include "saker/simulation/world/street_palette.h"

namespace saker::simulation {

/// Houses as add_building() draws them with what stands before their fronts: pilasters, porches,
/// steps, garage doors, awnings, bay windows, corner columns, dormers; all of it building.
void add_house(World& world, const StreetPalette& palette, const BuildingShape& shape,
               const SE3& T_world_corner, core::Rng& rng);

/// A house whose ground floor stands back behind columns, front along x at y = 0.
void add_arcade(World& world, const StreetPalette& palette, const BuildingShape& shape,
                const SE3& T_world_corner, core::Rng& rng);

/// A hall of cladding with gates, or a shed.
void add_hall(World& world, const StreetPalette& palette, double width, double depth, double height,
              const SE3& T_world_corner, core::Rng& rng);

/// A roof on posts, a shed or a carport, about the origin.
void add_shed(World& world, const StreetPalette& palette, const SE3& T_world_ground,
              core::Rng& rng);

/// A slab on pillars along x from the origin, over y of 0 to `depth`: a parking deck.
void add_deck(World& world, const StreetPalette& palette, double length, double depth,
              const SE3& T_world_corner, core::Rng& rng);

/// A bridge across the street, along y about the origin, `span` wide between its abutments.
void add_bridge(World& world, const StreetPalette& palette, double span, const SE3& T_world_middle,
                core::Rng& rng);

}  // namespace saker::simulation
