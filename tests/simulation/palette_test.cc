#include "saker/simulation/world/palette.h"

#include <gtest/gtest.h>

#include "drawn.h"

namespace saker::simulation {
namespace {

TEST(Palette, EachMaterialHasTheLabelOfItsName) {
  const Sketch s;
  const Palette& p = s.palette;
  const std::vector<std::pair<MaterialId, int>> expected = {{p.asphalt, kRoad},
                                                            {p.marking, kLaneMarking},
                                                            {p.parking, kParking},
                                                            {p.paving, kSidewalk},
                                                            {p.yard, kOtherGround},
                                                            {p.grass, kTerrain},
                                                            {p.meadow, kTerrain},
                                                            {p.leaves, kVegetation},
                                                            {p.twigs, kVegetation},
                                                            {p.hedge, kVegetation},
                                                            {p.bark, kTrunk},
                                                            {p.metal, kPole},
                                                            {p.sign, kTrafficSign},
                                                            {p.lamp, kPole},
                                                            {p.glass, kBuilding},
                                                            {p.plaster, kBuilding},
                                                            {p.wood, kFence},
                                                            {p.wire, kFence},
                                                            {p.concrete, kOtherStructure},
                                                            {p.person, kPerson},
                                                            {p.bicycle, kBicycle},
                                                            {p.structure, kOtherStructure},
                                                            {p.object, kOtherObject}};
  for (const auto& [material, label] : expected)
    EXPECT_EQ(s.world.materials[material].label, label) << material;
}

TEST(Palette, StreetsHaveTheirOwnMaterialsBesideThose) {
  const Sketch s;
  const StreetPalette& p = s.street;
  const std::vector<std::pair<MaterialId, int>> expected = {
      {p.water, kRoad},           {p.wet, kRoad},           {p.ice, kTerrain},
      {p.gravel, kOtherGround},   {p.soil, kTerrain},       {p.cobble, kRoad},
      {p.snow, kTerrain},         {p.steel, kRoad},         {p.stems, kVegetation},
      {p.ivy, kVegetation},       {p.blades, kVegetation},  {p.bloom, kVegetation},
      {p.iron, kFence},           {p.mesh, kFence},         {p.board, kFence},
      {p.plastic, kOtherObject},  {p.canvas, kOtherObject}, {p.timber, kOtherObject},
      {p.block, kOtherStructure}, {p.brick, kBuilding},     {p.cladding, kBuilding},
      {p.pane, kBuilding},        {p.frame, kBuilding}};
  for (const auto& [material, label] : expected)
    EXPECT_EQ(s.world.materials[material].label, label) << material;
  EXPECT_EQ(p.asphalt, s.palette.asphalt);
  EXPECT_EQ(p.bark, s.palette.bark);
}

TEST(Palette, EveryShareIsAShareInAllWorlds) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    for (const Material& m : Sketch(seed).world.materials) {
      for (const float share : {m.reflectivity, m.gloss, m.transmission, m.spread}) {
        EXPECT_GE(share, 0);
        EXPECT_LE(share, 1);
      }
      EXPECT_GE(m.depth, 0);
      EXPECT_LE(m.depth, 0.25F);
    }
  }
}

TEST(Palette, ReflectivitiesDifferByAQuarterFromWorldToWorld) {
  Spread asphalt;
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    const Sketch s(seed);
    asphalt.add(s.world.materials[s.palette.asphalt].reflectivity);
  }
  EXPECT_NEAR(asphalt.mean(), 0.26, 0.01);
  EXPECT_NEAR(asphalt.sd(), 0.22 * 0.26, 0.006);
}

TEST(Palette, OnlyGroundAndPlantsHaveADepth) {
  const Sketch s;
  const Palette& p = s.palette;
  for (const MaterialId m : {p.metal, p.sign, p.glass, p.plaster, p.concrete, p.wood, p.rubber})
    EXPECT_EQ(s.world.materials[m].depth, 0);
  EXPECT_GT(s.world.materials[p.meadow].depth, s.world.materials[p.asphalt].depth);
}

TEST(Palette, SignsAreTheBrightestAndRubberTheDarkest) {
  const Sketch s;
  EXPECT_GT(s.world.materials[s.palette.sign].reflectivity, 0.8F);
  EXPECT_LT(s.world.materials[s.palette.rubber].reflectivity, 0.1F);
}

TEST(Tinted, KeepsAllButTheReflectivity) {
  Sketch s;
  const MaterialId tinted_metal = tinted(s.world, s.palette.metal, 0.123);
  const Material& before = s.world.materials[s.palette.metal];
  const Material& after = s.world.materials[tinted_metal];
  EXPECT_NE(tinted_metal, s.palette.metal);
  EXPECT_FLOAT_EQ(after.reflectivity, 0.123F);
  EXPECT_EQ(after.label, before.label);
  EXPECT_EQ(after.gloss, before.gloss);
  EXPECT_EQ(after.transmission, before.transmission);
  EXPECT_EQ(after.depth, before.depth);
}

TEST(AnyTint, IsDrawnFromItsRange) {
  Sketch s;
  Spread reflectivity;
  for (int i = 0; i < 1000; ++i) {
    const MaterialId m = any_tint(s.world, s.street.plastic, 0.2, 0.6, s.rng);
    reflectivity.add(s.world.materials[m].reflectivity);
    ASSERT_GE(s.world.materials[m].reflectivity, 0.2F);
    ASSERT_LE(s.world.materials[m].reflectivity, 0.6F);
  }
  EXPECT_NEAR(reflectivity.mean(), 0.4, 0.01);
}

TEST(World, IdsOfObjectsBeginAtOneForZeroIsNone) {
  World world;
  EXPECT_EQ(world.add(TrueObject{"vehicle", "sedan", {}}), 1);
  EXPECT_EQ(world.add(TrueObject{"pole", "lamp", {}}), 2);
  EXPECT_EQ(world.add(Material{}), 0);
  EXPECT_EQ(world.add(Material{}), 1);
}

}  // namespace
}  // namespace saker::simulation
