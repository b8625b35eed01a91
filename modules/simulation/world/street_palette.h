#pragma once

#include "saker/simulation/world/palette.h"

namespace saker::simulation {

/// The materials that only training's streets hold, beside those of every world.
struct StreetPalette : Palette {
  MaterialId water, wet, ice, gravel, soil, cobble, snow;
  MaterialId steel;                      ///< rails of trams, covers of shafts: ground that shines
  MaterialId stems, ivy, blades, bloom;  ///< of plants, all vegetation
  MaterialId iron, mesh, board;          ///< of fences
  MaterialId plastic, canvas, timber;    ///< of objects
  MaterialId block;                      ///< concrete barriers and retaining walls: other structure
  MaterialId brick, cladding, pane, frame;  ///< of buildings
};

[[nodiscard]] StreetPalette make_street_palette(World& world, const Palette& palette,
                                                core::Rng& rng);

/// A material like `base` whose reflectivity is drawn from `low` to `high`.
[[nodiscard]] MaterialId any_tint(World& world, MaterialId base, double low, double high,
                                  core::Rng& rng);

/// What draws one thing at the origin of `T_world_ground`, upright, x along the street, y away
/// from it.
using StreetAdder = void (*)(World&, const StreetPalette&, const SE3&, core::Rng&);

}  // namespace saker::simulation
