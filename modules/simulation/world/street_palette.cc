#include "saker/simulation/world/street_palette.h"

namespace saker::simulation {
namespace {

void add_grounds(World& world, core::Rng& rng, StreetPalette& p) {
  const auto depth = [&](double low, double high) {
    return static_cast<float>(rng.uniform(low, high));
  };
  // Still water mirrors: a beam comes back only where it meets the ground squarely.
  p.water = world.add({kRoad, 0.05F, 0.04F, 0.99F, 0, 0});
  p.wet = world.add({kRoad, 0.09F, 0.05F, 0.93F, 0, 0.005F});
  p.ice = world.add({kTerrain, 0.35F, 0.2F, 0.9F, 0, 0});
  p.gravel = world.add({kOtherGround, 0.3F, 0.12F, 0, 0, depth(0.01, 0.05)});
  p.soil = world.add({kTerrain, 0.22F, 0.08F, 0, 0, depth(0.01, 0.06)});
  p.cobble = world.add({kRoad, 0.27F, 0.1F, 0, 0, depth(0.01, 0.03)});
  p.snow = world.add({kTerrain, 0.8F, 0.1F, 0, 0, 0.02F});
  p.steel = world.add({kRoad, 0.4F, 0.2F, 0.8F, 0, 0});
}

void add_greens(World& world, StreetPalette& p) {
  const Material& leaves = world.materials[p.leaves];
  const auto alike = [&](float scale, float transmission, float depth) {
    return Material{kVegetation, leaves.reflectivity * scale, 0.13F, 0.05F, transmission, depth};
  };
  const Material stems = alike(0.8F, 0, 0.01F);
  const Material ivy = alike(1.0F, 0.02F, 0.06F);
  const Material blades = alike(1.0F, 0.25F, 0.08F);
  const Material bloom = alike(1.4F, 0.05F, 0.05F);
  p.stems = world.add(stems);
  p.ivy = world.add(ivy);
  p.blades = world.add(blades);
  p.bloom = world.add(bloom);
}

void add_built(World& world, core::Rng& rng, StreetPalette& p) {
  const auto tone = [&](double low, double high) {
    return static_cast<float>(rng.uniform(low, high));
  };
  p.iron = world.add({kFence, tone(0.05, 0.3), 0.1F, 0.3F, 0, 0});
  p.mesh = world.add({kFence, tone(0.15, 0.4), 0.1F, 0, tone(0.5, 0.9), 0});
  p.board = world.add({kFence, tone(0.2, 0.5), 0.1F, 0, 0, 0});
  p.plastic = world.add({kOtherObject, tone(0.1, 0.5), 0.15F, 0.2F, 0, 0});
  p.canvas = world.add({kOtherObject, tone(0.3, 0.8), 0.1F, 0, 0, 0});
  p.timber = world.add({kOtherObject, tone(0.25, 0.5), 0.1F, 0, 0, 0});
  p.block = world.add({kOtherStructure, tone(0.25, 0.5), 0.09F, 0, 0, 0.01F});
  p.brick = world.add({kBuilding, tone(0.2, 0.5), 0.12F, 0, 0, 0.01F});
  p.cladding = world.add({kBuilding, tone(0.2, 0.7), 0.1F, 0.5F, 0, 0});
  p.pane = world.add({kBuilding, 0.05F, 0.04F, 0.99F, tone(0.2, 0.6), 0});
  p.frame = world.add({kBuilding, tone(0.1, 0.7), 0.1F, 0.3F, 0, 0});
}

}  // namespace

StreetPalette make_street_palette(World& world, const Palette& palette, core::Rng& rng) {
  StreetPalette p{};
  static_cast<Palette&>(p) = palette;
  add_grounds(world, rng, p);
  add_greens(world, p);
  add_built(world, rng, p);
  return p;
}

MaterialId any_tint(World& world, MaterialId base, double low, double high, core::Rng& rng) {
  return tinted(world, base, rng.uniform(low, high));
}

}  // namespace saker::simulation
