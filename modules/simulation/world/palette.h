#pragma once

#include "saker/core/rng.h"
#include "saker/simulation/world/world.h"

namespace saker::simulation {

/// The materials of one world; their reflectivities vary from world to world.
struct Palette {
  MaterialId asphalt, marking, parking, paving, yard, grass, meadow;
  MaterialId leaves, twigs, hedge, bark;
  MaterialId metal, sign, glass, plaster, concrete, wood, wire, rail;
  MaterialId interior, rubber, rim, lamp, plate, dark;
  MaterialId person, bicycle, object, structure;
  Paint paint = Paint::any;  ///< of its vehicles
};

[[nodiscard]] Palette make_palette(World& world, core::Rng& rng);

/// A material like `base` with another reflectivity.
[[nodiscard]] MaterialId tinted(World& world, MaterialId base, double reflectivity);

}  // namespace saker::simulation
