#include <gtest/gtest.h>

#include <set>

#include "drawn.h"
#include "saker/simulation/world/facades.h"
#include "saker/simulation/world/fences.h"
#include "saker/simulation/world/furnish_street.h"
#include "saker/simulation/world/ground_details.h"
#include "saker/simulation/world/street_furniture.h"
#include "saker/simulation/world/world_builder.h"

namespace saker::simulation {
namespace {

/// A world with nothing but the plants' prototypes.
struct Bare {
  Bare() : rng(5) {
    palette = make_palette(world, rng);
    street_palette = make_street_palette(world, palette, rng);
    flora = grow_flora(world, palette, rng);
    street_flora = grow_street_flora(world, street_palette, rng);
  }
  [[nodiscard]] Nursery nursery() { return {world, street_palette, flora, street_flora}; }

  core::Rng rng;
  World world;
  Palette palette{};
  StreetPalette street_palette{};
  Flora flora;
  StreetFlora street_flora;
};

/// How many separate hits a horizontal fan of rays at height z makes on the world's own mesh.
int stems_at(const World& world, double z) {
  const RayCaster caster(world);
  int stems = 0;
  bool inside = false;
  for (double y = -2; y < 2; y += 0.01) {
    Shot shot;
    shot.origin = Eigen::Vector3f(-20, static_cast<float>(y), static_cast<float>(z));
    caster.cast({&shot, 1}, 40);
    const bool trunk = shot.hit && world.materials[shot.material].label == kTrunk;
    if (trunk && !inside) ++stems;
    inside = trunk;
  }
  return stems;
}

TEST(Street, AClippedHedgeHasTheSizeThatWasAskedFor) {
  Bare bare;
  add_clipped_hedge(bare.nursery(), {5, 1.6, 1.4}, SE3::Identity(), bare.rng);
  const Eigen::AlignedBox3d box = box_of_placements(bare.world);
  EXPECT_NEAR(box.sizes().x(), 5, 0.35);
  EXPECT_NEAR(box.sizes().y(), 1.6, 0.3);
  EXPECT_NEAR(box.max().z(), 1.4, 0.15);
}

TEST(Street, EveryPlantButATrunkIsVegetation) {
  Bare bare;
  for (const Mesh& mesh : bare.world.prototypes)
    EXPECT_EQ(labels_of(bare.world, mesh), std::set<int>{kVegetation});
}

TEST(Street, ACarSizedBushIsAsLargeAsACar) {
  for (int seed = 0; seed < 20; ++seed) {
    Bare bare;
    core::Rng rng(static_cast<std::uint64_t>(seed));
    add_car_sized_bush(bare.nursery(), SE3::Identity(), rng);
    const Eigen::Vector3d size = box_of_placements(bare.world).sizes();
    EXPECT_GT(size.z(), 0.9) << seed;
    EXPECT_LT(size.z(), 2.1) << seed;
    EXPECT_GT(std::max(size.x(), size.y()), 1.3) << seed;
    EXPECT_LT(std::max(size.x(), size.y()), 6.6) << seed;
  }
}

TEST(Street, AForkedTreeHasOneStemBelowAndTwoAbove) {
  int forks = 0;
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    Bare bare;
    core::Rng rng(seed);
    add_street_tree(bare.nursery(), TreeHabit::forked, 1, SE3::Identity(), rng);
    bare.world.placements.clear();  // leaves hide the stems
    EXPECT_EQ(stems_at(bare.world, 0.2), 1) << seed;
    double top = 0;
    for (std::size_t i = 0; i < bare.world.mesh.triangles.size(); ++i) {
      if (bare.world.materials[bare.world.mesh.materials[i]].label != kTrunk) continue;
      for (const std::uint32_t v : bare.world.mesh.triangles[i])
        top = std::max(top, static_cast<double>(bare.world.mesh.vertices[v].z()));
    }
    forks += stems_at(bare.world, top - 0.8) >= 2 ? 1 : 0;
  }
  EXPECT_GE(forks, 5);  // the others' stems stand behind each other
}

TEST(Street, TheArmOfALampIsPole) {
  Bare bare;
  add_armed_lamp(bare.world, bare.street_palette, SE3::Identity(), bare.rng);
  double reach = 0;
  for (std::size_t i = 0; i < bare.world.mesh.triangles.size(); ++i) {
    EXPECT_EQ(bare.world.materials[bare.world.mesh.materials[i]].label, kPole);
    for (const std::uint32_t v : bare.world.mesh.triangles[i])
      reach = std::max(reach, std::abs(static_cast<double>(bare.world.mesh.vertices[v].y())));
  }
  EXPECT_GT(reach, 0.5);
}

TEST(Street, BoundariesAreFencesAndConcreteBarriersStructures) {
  for (int kind = 0; kind < kBoundaries; ++kind) {
    Bare bare;
    const auto boundary = static_cast<Boundary>(kind);
    add_boundary(bare.world, bare.street_palette, boundary, SE3::Identity(), 2.5, 1.5);
    const std::set<int> expected{boundary == Boundary::jersey ? kOtherStructure : kFence};
    EXPECT_EQ(labels_of(bare.world, bare.world.mesh), expected) << kind;
  }
}

TEST(Street, AHouseIsBuilding) {
  Bare bare;
  for (int i = 0; i < 10; ++i) {
    BuildingShape shape = random_building(bare.rng, false);
    add_arcade(bare.world, bare.street_palette, shape, SE3::Identity(), bare.rng);
  }
  EXPECT_EQ(labels_of(bare.world, bare.world.mesh), std::set<int>{kBuilding});
}

TEST(Street, NoThingOfAStreetIsAVehicle) {
  Bare bare;
  for (int i = 0; i < 200; ++i) {
    for (const Furnishing& thing :
         {any_small_thing(bare.rng), any_middling_thing(bare.rng), any_car_sized_thing(bare.rng)})
      thing.add(bare.world, bare.street_palette, SE3::Identity(), bare.rng);
  }
  const std::set<int> labels = labels_of(bare.world, bare.world.mesh);
  for (const int vehicle : {kCar, kBus, kTruck, kOtherVehicle, kBicycle, kPerson})
    EXPECT_FALSE(labels.contains(vehicle)) << vehicle;
  EXPECT_TRUE(labels.contains(kOtherObject));
}

Terrain flat_with(TerrainShape shape, const Palette& p, double kerb) {
  shape.relief_m = 0;
  shape.roughness_m = 0;
  CrossSection section;
  for (auto* side : {&section.left, &section.right}) {
    *side = {{3, p.asphalt, Use::lane, 0, 0}, {20, p.paving, Use::sidewalk, kerb, 0}};
  }
  core::Rng rng(1);
  return {shape, section, rng};
}

TEST(Street, ARampClimbsAsSteeplyAsWasAsked) {
  TerrainShape shape;
  shape.ramps.push_back({5, 25, 0.12});
  const Terrain terrain = flat_with(shape, {}, 0);
  EXPECT_NEAR(terrain.height(20, 1) - terrain.height(10, 1), 1.2, 1e-9);
  EXPECT_NEAR(terrain.height(40, 1) - terrain.height(0, 1), 2.4, 1e-9);
}

TEST(Street, AMoundHasItsHeightInTheMiddleAndNoneBeyondItsEdge) {
  TerrainShape shape;
  shape.swells.push_back({10, 8, 2, 2, 1.5, 0.6});
  const Terrain terrain = flat_with(shape, {}, 0);
  EXPECT_NEAR(terrain.height(10, 8), 0.6, 1e-9);
  EXPECT_NEAR(terrain.height(13.6, 8), 0, 1e-9);
}

TEST(Street, ADroppedKerbLeavesALipAndTheSidewalkRisesBehindIt) {
  TerrainShape shape;
  shape.dropped.push_back({1, 0, 4});
  const Terrain terrain = flat_with(shape, {}, 0.14);
  EXPECT_NEAR(terrain.height(2, 3.001) - terrain.height(2, 2.999), 0.15 * 0.14, 1e-3);
  EXPECT_NEAR(terrain.height(20, 3.001) - terrain.height(20, 2.999), 0.14, 1e-3);
  EXPECT_NEAR(terrain.height(2, 22.99), 0.14, 1e-3);
  EXPECT_NEAR(terrain.height(2, -3.001) - terrain.height(2, -2.999), 0.14, 1e-3);  // other side
}

TEST(Street, ATrainingWorldHasGroundUnderEveryLane) {
  const std::set<int> ground{kRoad, kLaneMarking, kParking, kSidewalk, kTerrain, kOtherGround};
  for (const WorldKind kind : {WorldKind::narrow, WorldKind::avenue, WorldKind::street}) {
    const BuiltWorld built = build_world(kind, 3);
    const RayCaster caster(built.world);
    for (double s = -80.13; s < 80; s += 2.71) {
      if (built.terrain.in_crossing(s, 1)) continue;
      double d = 0;
      for (const Strip& strip : built.terrain.section().left) {
        if (strip.use == Use::lane) {
          const Eigen::Vector3d p = built.terrain.point(s, d + strip.width / 2);
          Shot shot;  // from below: what stands on the lane is not in the way
          shot.origin = (p - Eigen::Vector3d(0, 0, 0.6)).cast<float>();
          shot.direction = Eigen::Vector3f::UnitZ();
          caster.cast({&shot, 1}, 2);
          ASSERT_TRUE(shot.hit) << s;
          EXPECT_NEAR(shot.distance, 0.6, 0.04) << s;
          EXPECT_TRUE(ground.contains(built.world.materials[shot.material].label));
        }
        d += strip.width;
      }
    }
  }
}

TEST(Street, EveryKindOfTownBuildsAFiniteMeshOfBoundedSize) {
  for (const WorldKind kind :
       {WorldKind::narrow, WorldKind::avenue, WorldKind::industry, WorldKind::square}) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      const World world = build_world(kind, seed).world;
      for (const Eigen::Vector3f& p : world.mesh.vertices) ASSERT_TRUE(p.allFinite());
      for (const MaterialId m : world.mesh.materials) ASSERT_LT(m, world.materials.size());
      for (const Placement& p : world.placements) ASSERT_LT(p.prototype, world.prototypes.size());
      EXPECT_LT(world.mesh.triangles.size(), 1'500'000U);
      EXPECT_LT(world.materials.size(), 20'000U);
    }
  }
}

TEST(Street, TrainingWorldsHoldPlantsFencesPolesAndObjects) {
  std::set<int> labels;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const World world = build_world(WorldKind::mixed, seed).world;
    for (const int label : labels_of(world, world.mesh)) labels.insert(label);
  }
  for (const int label : {kBuilding, kFence, kOtherStructure, kTrunk, kPole, kTrafficSign,
                          kOtherObject, kTerrain, kCar})
    EXPECT_TRUE(labels.contains(label)) << label;
}

}  // namespace
}  // namespace saker::simulation
