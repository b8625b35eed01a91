#pragma once

#include <string>
#include <vector>

#include "saker/simulation/world/terrain.h"

namespace saker::simulation {

enum class WorldKind {
  mixed,
  street,
  car_park,
  country,
  highway,
  campus,
  narrow,
  avenue,
  industry,
  square
};

[[nodiscard]] inline std::vector<std::string> enum_names(WorldKind) {
  return {"mixed",  "street", "car_park", "country",  "highway",
          "campus", "narrow", "avenue",   "industry", "square"};
}

/// `mixed` drawn: mostly streets.
[[nodiscard]] WorldKind any_world(core::Rng& rng);

/// A random section through a world of `kind`; strips reach about 60 m to each side.
[[nodiscard]] CrossSection random_section(WorldKind kind, const Palette& palette, core::Rng& rng);

/// A random ground to go with it.
[[nodiscard]] TerrainShape random_terrain(WorldKind kind, const Palette& palette, core::Rng& rng);

}  // namespace saker::simulation
