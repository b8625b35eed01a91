#include "saker/simulation/sensor/ray_caster.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace saker::simulation
