#include "saker/simulation/world/world_builder.h"

#include <gtest/gtest.h>

#include <map>

#include "saker/simulation/mission/flight.h"

namespace saker::simulation {
namespace {

TEST(WorldBuilder, TheSameSeedBuildsTheSameWorld) {
  const BuiltWorld a = build_world(WorldKind::street, 11);
  const BuiltWorld b = build_world(WorldKind::street, 11);
  ASSERT_EQ(a.world.mesh.vertices.size(), b.world.mesh.vertices.size());
  EXPECT_EQ(a.world.mesh.vertices, b.world.mesh.vertices);
  EXPECT_EQ(a.world.placements.size(), b.world.placements.size());
  EXPECT_NE(build_world(WorldKind::street, 12).world.mesh.vertices.size(),
            a.world.mesh.vertices.size());
}

TEST(WorldBuilder, EveryKindHasAFiniteMeshAndValidIndices) {
  for (const WorldKind kind : {WorldKind::street, WorldKind::car_park, WorldKind::country,
                               WorldKind::highway, WorldKind::campus}) {
    const World world = build_world(kind, 21).world;
    ASSERT_FALSE(world.mesh.triangles.empty());
    for (const Eigen::Vector3f& p : world.mesh.vertices) ASSERT_TRUE(p.allFinite());
    for (const MaterialId m : world.mesh.materials) ASSERT_LT(m, world.materials.size());
    for (const ObjectId o : world.mesh.objects) ASSERT_LE(o, world.objects.size());
    for (const Placement& p : world.placements) ASSERT_LT(p.prototype, world.prototypes.size());
  }
}

/// Cars of one world, as discs about their middles.
TEST(WorldBuilder, NoTwoVehiclesStandInEachOther) {
  for (std::uint64_t seed = 1; seed < 6; ++seed) {
    const World world = build_world(WorldKind::car_park, seed).world;
    std::vector<objects::Cuboid> cars;
    for (const TrueObject& o : world.objects) {
      if (o.class_name == "vehicle") cars.push_back(std::get<objects::Cuboid>(o.model));
    }
    for (std::size_t i = 0; i < cars.size(); ++i) {
      for (std::size_t k = i + 1; k < cars.size(); ++k) {
        const Eigen::Vector3d apart = cars[i].pose.translation() - cars[k].pose.translation();
        EXPECT_GT(apart.head<2>().norm(), 1.6);
      }
    }
  }
}

std::map<std::uint16_t, int> triangles_by_label(const World& world) {
  std::map<std::uint16_t, int> count;
  for (const MaterialId m : world.mesh.materials) ++count[world.materials[m].label];
  return count;
}

TEST(WorldBuilder, TrainingWorldsHoldEveryKindOfRoadUser) {
  std::map<std::uint16_t, int> worlds_with;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const World world = build_world(WorldKind::street, seed).world;
    for (const auto& [label, triangles] : triangles_by_label(world)) ++worlds_with[label];
  }
  for (const int label : {kCar, kVan, kTruck, kBus, kOtherVehicle, kMotorcycle, kBicycle, kPerson,
                          kBicyclist, kMotorcyclist}) {
    EXPECT_GE(worlds_with[static_cast<std::uint16_t>(label)], 2) << label;
  }
}

/// Maps know the vehicles of vehicle.h only.
TEST(WorldBuilder, AFlightHasNoneOfTheFleetOfTrainingWorlds) {
  std::map<std::uint16_t, int> count = triangles_by_label(build_flight_world({}, 3).built.world);
  for (const int label : {kVan, kTruck, kBus, kMotorcycle, kBicyclist}) {
    EXPECT_EQ(count[static_cast<std::uint16_t>(label)], 0) << label;
  }
  EXPECT_GT(count[kCar], 0);
}

TEST(WorldBuilder, AFlightPassesAllFiveKindsOfCarsTreesAndPoles) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const World world = build_flight_world({}, seed).built.world;
    std::map<std::string, int> kinds, classes;
    for (const TrueObject& o : world.objects) {
      ++classes[o.class_name];
      if (o.class_name == "vehicle") ++kinds[o.kind];
    }
    EXPECT_EQ(kinds.size(), 5U) << "seed " << seed;
    EXPECT_GE(classes["vehicle"], 6);
    EXPECT_GE(classes["trunk"], 8);
    EXPECT_GE(classes["pole"], 4);
  }
}

}  // namespace
}  // namespace saker::simulation
