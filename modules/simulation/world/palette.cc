#include "saker/simulation/world/palette.h"

#include <algorithm>

namespace saker::simulation {
namespace {

/// Reflectivity around `mean`: worlds differ by about a quarter.
float around(core::Rng& rng, double mean) {
  return static_cast<float>(std::clamp(mean * rng.normal(1, 0.22), 0.01, 0.95));
}

void add_ground(World& world, core::Rng& rng, Palette& p) {
  p.asphalt = world.add({kRoad, around(rng, 0.26), 0.05F, 0, 0, 0.01F});
  p.marking = world.add({kLaneMarking, around(rng, 0.45), 0.1F, 0, 0, 0});
  p.parking = world.add({kParking, around(rng, 0.28), 0.06F, 0, 0, 0.01F});
  p.paving = world.add({kSidewalk, around(rng, 0.31), 0.05F, 0, 0, 0.01F});
  p.yard = world.add({kOtherGround, around(rng, 0.27), 0.07F, 0, 0, 0.02F});
  p.grass = world.add(
      {kTerrain, around(rng, 0.34), 0.07F, 0, 0, static_cast<float>(rng.uniform(0.02, 0.07))});
  p.meadow = world.add(
      {kTerrain, around(rng, 0.35), 0.08F, 0, 0, static_cast<float>(rng.uniform(0.06, 0.22))});
}

void add_plants(World& world, core::Rng& rng, Palette& p) {
  p.leaves = world.add({kVegetation, around(rng, 0.36), 0.12F, 0.1F, 0.05F, 0});
  p.twigs = world.add({kVegetation, around(rng, 0.3), 0.1F, 0, 0, 0});
  p.hedge = world.add({kVegetation, around(rng, 0.33), 0.12F, 0, 0, 0.08F});
  p.bark = world.add({kTrunk, around(rng, 0.32), 0.09F, 0, 0, 0.015F});
}

void add_built(World& world, core::Rng& rng, Palette& p) {
  p.metal = world.add({kPole, around(rng, 0.25), 0.12F, 0.4F, 0, 0});
  p.sign = world.add({kTrafficSign, 0.85F, 0.15F, 0, 0, 0});
  p.lamp = world.add({kPole, around(rng, 0.3), 0.1F, 0.3F, 0.1F, 0});
  p.glass = world.add({kBuilding, 0.05F, 0.05F, 0.995F, 0.3F, 0});
  p.plaster = world.add({kBuilding, around(rng, 0.4), 0.08F, 0, 0, 0});
  p.concrete = world.add({kOtherStructure, around(rng, 0.35), 0.08F, 0, 0, 0});
  p.wood = world.add({kFence, around(rng, 0.33), 0.08F, 0, 0, 0});
  p.wire = world.add({kFence, around(rng, 0.3), 0.1F, 0, 0.72F, 0});
  p.rail = world.add({kFence, around(rng, 0.35), 0.12F, 0.4F, 0, 0});
  p.structure = world.add({kOtherStructure, around(rng, 0.3), 0.1F, 0.1F, 0, 0});
}

void add_small(World& world, core::Rng& rng, Palette& p) {
  p.interior = world.add({kCar, 0.12F, 0.1F, 0, 0, 0});
  p.rubber = world.add({kCar, 0.06F, 0.04F, 0, 0, 0});
  p.rim = world.add({kCar, 0.35F, 0.2F, 0.5F, 0.15F, 0});
  p.plate = world.add({kCar, 0.9F, 0.1F, 0, 0, 0});
  p.dark = world.add({kCar, 0.04F, 0.03F, 0.2F, 0, 0});
  p.person = world.add({kPerson, around(rng, 0.3), 0.12F, 0, 0, 0.01F});
  p.bicycle = world.add({kBicycle, around(rng, 0.25), 0.15F, 0.2F, 0, 0});
  p.object = world.add({kOtherObject, around(rng, 0.33), 0.1F, 0.1F, 0, 0});
}

}  // namespace

Palette make_palette(World& world, core::Rng& rng) {
  Palette palette{};
  add_ground(world, rng, palette);
  add_plants(world, rng, palette);
  add_built(world, rng, palette);
  add_small(world, rng, palette);
  return palette;
}

MaterialId tinted(World& world, MaterialId base, double reflectivity) {
  Material material = world.materials[base];
  material.reflectivity = static_cast<float>(reflectivity);
  return world.add(material);
}

}  // namespace saker::simulation
