#pragma once

#include "saker/simulation/world/layout.h"
#include "saker/simulation/world/street_palette.h"

namespace saker::simulation {

/// One side of a street of the kinds that only training has: narrow, avenue, industry, square.
[[nodiscard]] std::vector<Strip> town_side(WorldKind kind, const Palette& palette, core::Rng& rng);

/// Changes both sides' strips as training wants them: houses for plain buildings, lumps on soft
/// ground, slopes and ditches that are steeper, kerbs of other heights, cobbles, gravel and soil.
void vary_section(CrossSection& section, World& world, const StreetPalette& palette,
                  core::Rng& rng);

/// Adds what training's grounds have: ramps, mounds and hollows, dropped kerbs.
void vary_ground(TerrainShape& shape, WorldKind kind, core::Rng& rng);

}  // namespace saker::simulation
