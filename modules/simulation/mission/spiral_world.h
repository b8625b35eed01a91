#pragma once

#include "saker/simulation/mission/spiral_path.h"
#include "saker/simulation/world/world.h"

namespace saker::simulation {

/// What a spiral is flown about: a vehicle (number % 5: its kind), a trunk or a pole (number % 4).
struct SpiralSubject {
  std::string class_name;
  int number = 0;
};

/// One object on uneven ground, cars parked beside it, clutter and trees about, houses and trees
/// around, and a spiral that touches nothing.
struct SpiralWorld {
  World world;
  ObjectId subject = 0;
  SpiralPath path;
};

/// A function of its arguments. Throws Error on a class that it cannot make.
[[nodiscard]] SpiralWorld build_spiral_world(const SpiralConfig& config,
                                             const SpiralSubject& subject, std::uint64_t seed);

}  // namespace saker::simulation
