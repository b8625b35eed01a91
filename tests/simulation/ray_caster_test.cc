#include "saker/simulation/sensor/ray_caster.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "drawn.h"

namespace saker::simulation {
namespace {

World world_with_box() {
  World world;
  const MaterialId material = world.add({kBuilding, 0.4F, 0, 0, 0, 0});
  Pen(world.mesh, placed(10, 0, 0), 7).box({-1, -1, -1}, {1, 1, 1}, material);
  return world;
}

Shot shot_along(const Eigen::Vector3f& direction) {
  Shot shot;
  shot.direction = direction.normalized();
  return shot;
}

TEST(RayCaster, MeetsABoxAtItsFace) {
  const World world = world_with_box();
  const RayCaster caster(world);
  std::vector<Shot> shots = {shot_along({1, 0, 0}), shot_along({1, 0.05F, 0}),
                             shot_along({-1, 0, 0})};
  caster.cast(shots, 100);
  ASSERT_TRUE(shots[0].hit);
  EXPECT_NEAR(shots[0].distance, 9, 1e-4);
  EXPECT_NEAR(shots[0].cosine, 1, 1e-5);
  EXPECT_EQ(shots[0].object, 7);
  ASSERT_TRUE(shots[1].hit);
  EXPECT_NEAR(shots[1].distance * shots[1].direction.x(), 9, 1e-4);
  EXPECT_FALSE(shots[2].hit);
}

TEST(RayCaster, SeesNothingBeyondItsReach) {
  const World world = world_with_box();
  const RayCaster caster(world);
  std::vector<Shot> shots = {shot_along({1, 0, 0})};
  caster.cast(shots, 8.5F);
  EXPECT_FALSE(shots[0].hit);
}

TEST(RayCaster, APlacedPrototypeIsMetWhereItWasPutWithItsNormalTurned) {
  World world;
  const MaterialId material = world.add({kVegetation, 0.4F, 0, 0, 0, 0});
  Mesh mesh;
  Pen(mesh).box({-0.5, -0.5, 0}, {0.5, 0.5, 1}, material);
  world.prototypes.push_back(mesh);
  Pen(world.mesh).box({-100, -100, -11}, {100, 100, -10}, material);
  Eigen::Affine3f T = Eigen::Affine3f::Identity();
  T.translate(Eigen::Vector3f(0, 20, -1)).scale(Eigen::Vector3f(4, 2, 6));
  world.placements.push_back({0, T, 3});
  const RayCaster caster(world);
  std::vector<Shot> shots = {shot_along({0, 1, 0}), shot_along({0, 0, -1})};
  caster.cast(shots, 100);
  ASSERT_TRUE(shots[0].hit);
  EXPECT_NEAR(shots[0].distance, 19, 1e-3);
  EXPECT_NEAR(shots[0].cosine, 1, 1e-4);
  EXPECT_EQ(shots[0].object, 3);
  ASSERT_TRUE(shots[1].hit);
  EXPECT_NEAR(shots[1].distance, 10, 1e-3);
  EXPECT_EQ(shots[1].object, 0);
}

TEST(RayCaster, AMoverIsMetWhereItWasMovedTo) {
  World world = world_with_box();
  Mesh mesh;
  Pen(mesh).box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}, 0);
  world.prototypes.push_back(mesh);
  world.movers.push_back({0, Eigen::Affine3f(Eigen::Translation3f(5, 0, 0)), 9});
  RayCaster caster(world);
  Shot shot = shot_along({1, 0, 0});
  caster.cast({&shot, 1}, 100);
  EXPECT_NEAR(shot.distance, 4.5, 1e-4);
  EXPECT_EQ(shot.object, 9);
  caster.move(0, Eigen::Affine3f(Eigen::Translation3f(5, 3, 0)));
  caster.cast({&shot, 1}, 100);
  EXPECT_NEAR(shot.distance, 9, 1e-4);
  EXPECT_EQ(shot.object, 7);
}

/// Distance along a ray to a sphere about the origin that is seen from outside; NaN where none is.
double to_sphere(const Eigen::Vector3d& from, const Eigen::Vector3d& direction, double radius) {
  const double along = -from.dot(direction);
  const double inside = radius * radius - (from.squaredNorm() - along * along);
  return inside > 0 ? along - std::sqrt(inside) : NAN;
}

/// A sphere of radius 2 m about the origin, of 80 by 160 faces.
World world_with_sphere() {
  constexpr int kRings = 80, kSides = 160;
  constexpr double kRadius = 2;
  World world;
  world.add({kOtherObject, 0.3F, 0, 0, 0, 0});
  Pen pen(world.mesh);
  const auto point = [&](int ring, int side) {
    const double up = M_PI * (ring / double{kRings} - 0.5), around = 2 * M_PI * side / kSides;
    return Eigen::Vector3d(kRadius * std::cos(up) * std::cos(around),
                           kRadius * std::cos(up) * std::sin(around), kRadius * std::sin(up));
  };
  for (int ring = 0; ring < kRings; ++ring) {
    for (int side = 0; side < kSides; ++side)
      pen.quad(point(ring, side), point(ring, side + 1), point(ring + 1, side + 1),
               point(ring + 1, side), 0);
  }
  return world;
}

Eigen::Vector3d any_direction(core::Rng& rng) {
  return Eigen::Vector3d(rng.normal(), rng.normal(), rng.normal()).normalized();
}

TEST(RayCaster, RangesToASphereAreTheAnalyticOnes) {
  const World world = world_with_sphere();
  const RayCaster caster(world);
  core::Rng rng(4);
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3d from = 8 * any_direction(rng);
    const Eigen::Vector3d aim = 1.9 * rng.uniform() * any_direction(rng);
    const Eigen::Vector3d direction = (aim - from).normalized();
    const double expected = to_sphere(from, direction, 2);
    const Shot shot = shoot(caster, from, direction);
    ASSERT_TRUE(shot.hit);
    if (std::abs(shot.cosine) < 0.3) continue;  // the facets show at grazing angles
    EXPECT_NEAR(shot.distance, expected, 0.02);
    ++hits;
  }
  EXPECT_GT(hits, 1000);
}

TEST(RayCaster, CosinesOnASphereAreTheAnalyticOnes) {
  const World world = world_with_sphere();
  const RayCaster caster(world);
  core::Rng rng(6);
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector3d from = 8 * any_direction(rng);
    const Shot shot = shoot(caster, from, 1.5 * any_direction(rng) - from);
    ASSERT_TRUE(shot.hit);
    const Eigen::Vector3d normal = place_of(shot).normalized();
    EXPECT_NEAR(shot.cosine, std::abs(normal.dot(shot.direction.cast<double>())), 0.04);
  }
}

TEST(RayCaster, TheNearestPointOfASphereIsAsFarAsItsSurface) {
  const World world = world_with_sphere();
  const RayCaster caster(world);
  core::Rng rng(5);
  for (int i = 0; i < 500; ++i) {
    const double away = rng.uniform(0.1, 6);
    const Eigen::Vector3d from = away * any_direction(rng);
    const auto near = caster.nearest(from.cast<float>(), 10, {false});
    ASSERT_TRUE(near.has_value());
    EXPECT_NEAR(near->distance, std::abs(away - 2), 0.01);
    EXPECT_NEAR((near->point - from.cast<float>()).norm(), near->distance, 1e-3);
  }
}

TEST(RayCaster, NothingIsNearerThanTheReach) {
  const World world = world_with_box();
  const RayCaster caster(world);
  EXPECT_FALSE(caster.nearest({0, 0, 0}, 8.9F, {false}).has_value());
  EXPECT_TRUE(caster.nearest({0, 0, 0}, 9.1F, {false}).has_value());
}

TEST(RayCaster, WhatIsIgnoredIsNotNear) {
  World world = world_with_box();
  const MaterialId other = world.add({kTerrain, 0.4F, 0, 0, 0, 0});
  Pen(world.mesh).box({2, -1, -1}, {3, 1, 1}, other);
  const RayCaster caster(world);
  EXPECT_EQ(caster.nearest({0, 0, 0}, 20, {false, false})->material, other);
  EXPECT_EQ(caster.nearest({0, 0, 0}, 20, {false, true})->material, 0);
}

TEST(RayCaster, WhatIsNearerThanNearIsPassed) {
  const World world = world_with_box();
  const RayCaster caster(world);
  Shot shot = shot_along({1, 0, 0});
  shot.near = 9.5F;
  caster.cast({&shot, 1}, 100);
  ASSERT_TRUE(shot.hit);
  EXPECT_NEAR(shot.distance, 11, 1e-4);  // the far face
}

TEST(RayCaster, BothFacesOfATriangleAreMet) {
  World world;
  world.add({kOtherObject, 0.3F, 0, 0, 0, 0});
  Pen(world.mesh).quad({0, -1, -1}, {0, 1, -1}, {0, 1, 1}, {0, -1, 1}, 0);
  const RayCaster caster(world);
  for (const double side : {-1.0, 1.0}) {
    const Shot shot = shoot(caster, {4 * side, 0.2, 0.1}, {-side, 0, 0});
    ASSERT_TRUE(shot.hit);
    EXPECT_NEAR(shot.distance, 4, 1e-5);
    EXPECT_NEAR(shot.cosine, 1, 1e-5);
  }
}

/// Beams along the upright edges of a round wall, from its middle.
TEST(RayCaster, NothingPassesWhereTrianglesMeet) {
  constexpr int kSides = 64, kBeams = 100;
  const auto corner = [](int side, double z) {
    const double angle = 2 * std::numbers::pi * side / kSides;
    return Eigen::Vector3d(19.9 * std::cos(angle), 19.9 * std::sin(angle), z);
  };
  World world;
  const MaterialId material = world.add({kBuilding, 0.4F, 0, 0, 0, 0});
  std::vector<Shot> shots;
  for (int side = 0; side < kSides; ++side) {
    Pen(world.mesh)
        .quad(corner(side, -2), corner(side + 1, -2), corner(side + 1, 3), corner(side, 3),
              material);
    for (int beam = 0; beam < kBeams; ++beam)
      shots.push_back(shot_along(corner(side, -1.9 + 4.8 * beam / kBeams).cast<float>()));
  }
  RayCaster(world).cast(shots, 100);
  EXPECT_EQ(std::ranges::count(shots, true, &Shot::hit), kSides * kBeams);
}

/// Moving the world and the rays by the same motion changes no range.
TEST(RayCaster, RangesDoNotDependOnWhereTheWorldIs) {
  core::Rng rng(12);
  World here, there;
  for (World* world : {&here, &there}) world->add({kOtherObject, 0.3F, 0, 0, 0, 0});
  const SE3 T = placed(3, -7, 2, 1.2);
  Pen(here.mesh).tube({{0, 0, -1}, {0.5, 0, 1}, {0, 0.5, 2}}, {0.8, 0.5, 0.2}, 9, 0);
  Pen(there.mesh, T).tube({{0, 0, -1}, {0.5, 0, 1}, {0, 0.5, 2}}, {0.8, 0.5, 0.2}, 9, 0);
  const RayCaster a(here), b(there);
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector3d from = 5 * any_direction(rng);
    const Eigen::Vector3d direction = (0.4 * any_direction(rng) - from).normalized();
    const Shot first = shoot(a, from, direction),
               second = shoot(b, T * from, T.linear() * direction);
    ASSERT_EQ(first.hit, second.hit);
    if (first.hit && first.cosine > 0.2F) {
      EXPECT_NEAR(first.distance, second.distance, 1e-3);
    }
  }
}

TEST(RayCaster, ManyRaysAtOnceMeetWhatEachMeetsAlone) {
  const World world = world_with_box();
  const RayCaster caster(world);
  core::Rng rng(3);
  std::vector<Shot> shots;
  for (int i = 0; i < 37; ++i)
    shots.push_back(
        shot_along(Eigen::Vector3d(1, rng.normal(0, 0.1), rng.normal(0, 0.1)).cast<float>()));
  std::vector<Shot> together = shots;
  caster.cast(together, 100);
  for (std::size_t i = 0; i < shots.size(); ++i) {
    caster.cast({&shots[i], 1}, 100);
    EXPECT_EQ(shots[i].hit, together[i].hit);
    EXPECT_EQ(shots[i].distance, together[i].distance);
  }
}

}  // namespace
}  // namespace saker::simulation
