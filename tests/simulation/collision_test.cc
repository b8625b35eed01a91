#include "saker/simulation/vehicle/collision.h"

#include <gtest/gtest.h>

#include "saker/core/rng.h"
#include "saker/simulation/world/triangle.h"

namespace saker::simulation {
namespace {

const Material kGround{kRoad, 0.3F, 0, 0, 0, 0};
const Material kSolid{kBuilding, 0.3F, 0, 0, 0, 0};
const Material kLeaf{kVegetation, 0.3F, 0, 0, 0, 0};

/// A plain with a wall whose face is at x = 5.
World walled() {
  World world;
  const MaterialId ground = world.add(kGround);
  const MaterialId wall = world.add(kSolid);
  Pen(world.mesh).quad({-50, -50, 0}, {50, -50, 0}, {50, 50, 0}, {-50, 50, 0}, ground);
  Pen(world.mesh).box({5, -5, 0}, {5.3, 5, 6}, wall);
  return world;
}

TEST(CollisionMonitor, ClearanceIsTheDistanceOfTheSphereToTheWall) {
  const World world = walled();
  const RayCaster caster(world);
  CollisionMonitor contacts(caster, world, 0.4);
  contacts.check({2, 1, 2});
  EXPECT_NEAR(contacts.min_clearance(), 2.6, 1e-5);
  contacts.check({0, 0, 2});
  EXPECT_NEAR(contacts.min_clearance(), 2.6, 1e-5);
  EXPECT_EQ(contacts.nearest_label(), kBuilding);
  EXPECT_EQ(contacts.collisions(), 0);
}

TEST(CollisionMonitor, AContactIsCountedOnceUntilItEnds) {
  const World world = walled();
  const RayCaster caster(world);
  CollisionMonitor contacts(caster, world, 0.4);
  for (const double x : {4.5, 4.7, 4.62, 4.58, 4.7}) contacts.check({x, 0, 2});
  EXPECT_EQ(contacts.collisions(), 1);
  contacts.check({4, 0, 2});
  EXPECT_FALSE(contacts.touching());
  contacts.check({4.7, 0, 2});
  EXPECT_EQ(contacts.collisions(), 2);
}

TEST(CollisionMonitor, TheGroundIsNoObstacle) {
  const World world = walled();
  const RayCaster caster(world);
  CollisionMonitor contacts(caster, world, 0.4);
  contacts.check({-20, 0, 0.1});
  EXPECT_EQ(contacts.collisions(), 0);
}

/// A leaf placed at another size along each axis, and one that moves.
TEST(CollisionMonitor, PlacedAndMovedMeshesCountAtTheirTrueDistance) {
  World world;
  const MaterialId leaf = world.add(kLeaf);
  Mesh unit;
  Pen(unit).quad({0, -1, -1}, {0, 1, -1}, {0, 1, 1}, {0, -1, 1}, leaf);
  world.prototypes.push_back(unit);
  Eigen::Affine3f T = Eigen::Affine3f::Identity();
  T.translate(Eigen::Vector3f(3, 0, 0)).scale(Eigen::Vector3f(2, 0.5F, 4));
  world.placements.push_back({0, T, 0});
  world.movers.push_back({0, Eigen::Affine3f(Eigen::Translation3f(0, 0, -500)), 0});
  RayCaster caster(world);
  CollisionMonitor still(caster, world, 0.5);
  still.check({0, 0, 0});
  EXPECT_NEAR(still.min_clearance(), 2.5, 1e-5);
  still.check({3, 1.5, 3});
  EXPECT_NEAR(still.min_clearance(), 0.5, 1e-5);
  caster.move(0, Eigen::Affine3f(Eigen::Translation3f(-1, 0, 0)));
  still.check({0, 0, 0});
  EXPECT_NEAR(still.min_clearance(), 0.5, 1e-5);
  still.check({-1, 0, 1.2});
  EXPECT_EQ(still.collisions(), 1);
  EXPECT_EQ(still.nearest_label(), kVegetation);
}

TEST(Triangle, NoPointOfItIsNearerThanTheNearest) {
  core::Rng rng(7);
  const auto any = [&] {
    return Eigen::Vector3d(rng.normal(), rng.normal(), rng.normal()).cast<float>().eval();
  };
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3f a = any(), b = any(), c = any(), p = 2 * any();
    const float least = (closest_on_triangle(p, a, b, c) - p).norm();
    float sampled = 1e9F;
    for (int u = 0; u <= 20; ++u) {
      for (int v = 0; u + v <= 20; ++v) {
        const Eigen::Vector3f q =
            a + 0.05F * static_cast<float>(u) * (b - a) + 0.05F * static_cast<float>(v) * (c - a);
        sampled = std::min(sampled, (q - p).norm());
      }
    }
    EXPECT_LE(least, sampled + 1e-4F);
    EXPECT_GE(least, sampled - 0.15F * ((b - a).norm() + (c - a).norm()));
  }
}

TEST(GroundMaterials, AreWhatOneLandsOn) {
  World world;
  for (const std::uint16_t label :
       {kRoad, kParking, kSidewalk, kOtherGround, kLaneMarking, kTerrain, kCar, kBuilding, kFence,
        kVegetation, kTrunk, kPole, kPerson})
    world.add({label, 0.3F, 0, 0, 0, 0});
  const std::vector<bool> ground = ground_materials(world);
  ASSERT_EQ(ground.size(), 13U);
  for (std::size_t i = 0; i < ground.size(); ++i) EXPECT_EQ(ground[i], i < 6) << i;
}

/// Random boxes: the clearance is the analytic distance to the nearest of them.
TEST(CollisionMonitor, TheLeastClearanceOfAFlightIsTheAnalyticOne) {
  core::Rng rng(21);
  for (int flight = 0; flight < 30; ++flight) {
    World world;
    const MaterialId solid = world.add(kSolid);
    std::vector<Eigen::AlignedBox3d> boxes;
    for (int i = 0; i < 8; ++i) {
      const Eigen::Vector3d low(rng.uniform(-8, 8), rng.uniform(-8, 8), rng.uniform(-8, 8));
      const Eigen::Vector3d size(rng.uniform(0.2, 2), rng.uniform(0.2, 2), rng.uniform(0.2, 2));
      boxes.emplace_back(low, low + size);
      Pen(world.mesh).box(low, low + size, solid);
    }
    const RayCaster caster(world);
    CollisionMonitor contacts(caster, world, 0.3);
    double least = CollisionMonitor::kReach;
    for (int i = 0; i < 10; ++i) {
      const Eigen::Vector3d at(rng.uniform(-9, 9), rng.uniform(-9, 9), rng.uniform(-9, 9));
      double distance = 100;
      for (const auto& box : boxes) distance = std::min(distance, box.exteriorDistance(at));
      if (distance < 0.5) continue;  // within a box the surface counts
      contacts.check(at);
      least = std::min(least, distance - 0.3);
    }
    if (least < CollisionMonitor::kReach) {
      EXPECT_NEAR(contacts.min_clearance(), least, 1e-4);
    }
    EXPECT_EQ(contacts.collisions(), 0);
  }
}

TEST(CollisionMonitor, ALargerSphereComesNearer) {
  const World world = walled();
  const RayCaster caster(world);
  for (const double radius : {0.2, 0.4, 1.0}) {
    CollisionMonitor contacts(caster, world, radius);
    contacts.check({2, 0, 2});
    EXPECT_NEAR(contacts.min_clearance(), 3 - radius, 1e-5);
  }
}

TEST(CollisionMonitor, TouchingLastsUntilThereAreTenCentimetres) {
  const World world = walled();
  const RayCaster caster(world);
  CollisionMonitor contacts(caster, world, 0.4);
  contacts.check({4.7, 0, 2});
  EXPECT_TRUE(contacts.touching());
  contacts.check({4.55, 0, 2});  // 5 cm
  EXPECT_TRUE(contacts.touching());
  contacts.check({4.45, 0, 2});  // 15 cm
  EXPECT_FALSE(contacts.touching());
}

TEST(Triangle, APointAboveItIsNearestToItsFoot) {
  const Eigen::Vector3f a(0, 0, 0), b(4, 0, 0), c(0, 4, 0);
  const Eigen::Vector3f foot = closest_on_triangle({1, 1, 7}, a, b, c);
  EXPECT_LT((foot - Eigen::Vector3f(1, 1, 0)).norm(), 1e-6F);
}

TEST(Triangle, APointBeyondACornerIsNearestToTheCorner) {
  const Eigen::Vector3f a(0, 0, 0), b(4, 0, 0), c(0, 4, 0);
  EXPECT_EQ(closest_on_triangle({-1, -1, 0}, a, b, c), a);
  EXPECT_EQ(closest_on_triangle({9, -1, 0}, a, b, c), b);
  EXPECT_EQ(closest_on_triangle({-1, 9, 0}, a, b, c), c);
}

TEST(Triangle, APointBesideAnEdgeIsNearestToTheEdge) {
  const Eigen::Vector3f a(0, 0, 0), b(4, 0, 0), c(0, 4, 0);
  EXPECT_LT((closest_on_triangle({2, -3, 0}, a, b, c) - Eigen::Vector3f(2, 0, 0)).norm(), 1e-6F);
  EXPECT_LT((closest_on_triangle({5, 5, 0}, a, b, c) - Eigen::Vector3f(2, 2, 0)).norm(), 1e-6F);
}

}  // namespace
}  // namespace saker::simulation
