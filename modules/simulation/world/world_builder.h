#pragma once

#include "saker/simulation/world/populate.h"

namespace saker::simulation {

/// A world with the ground it stands on.
struct BuiltWorld {
  World world;
  Terrain terrain;
  WorldKind kind;
  std::vector<Eigen::Vector2d>
      free_places;  ///< (s, d) on roads and paths where a sensor on a car or in a hand may be
};

/// A random world of `kind`, a function of the seed alone: about 190 m of street with 60 m to both
/// sides.
[[nodiscard]] BuiltWorld build_world(WorldKind kind, std::uint64_t seed);

}  // namespace saker::simulation
