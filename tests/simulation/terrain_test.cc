#include "saker/simulation/world/terrain.h"

#include <gtest/gtest.h>

#include "drawn.h"
#include "saker/simulation/sensor/ray_caster.h"

namespace saker::simulation {
namespace {

struct Ground {
  World world;
  Palette palette;
  std::unique_ptr<Terrain> terrain;
};

Ground make_ground(double bend_m) {
  Ground g;
  core::Rng rng(4);
  g.palette = make_palette(g.world, rng);
  CrossSection section;
  for (auto* side : {&section.left, &section.right}) {
    *side = {{3, g.palette.asphalt, Use::lane, 0, -0.02},
             {20, g.palette.paving, Use::sidewalk, 0.12, 0.02}};
  }
  TerrainShape shape;
  shape.bend_m = bend_m;
  shape.grade = 0.05;
  g.terrain = std::make_unique<Terrain>(shape, section, rng);
  g.terrain->draw(g.world);
  return g;
}

TEST(Terrain, TheDrawnGroundLiesAtTheHeightItSays) {
  const Ground g = make_ground(3);
  const RayCaster caster(g.world);
  for (double s = -40; s < 40; s += 3.3) {
    for (const double d : {-15.0, -4.1, -1.0, 0.7, 2.2, 9.4}) {
      const Eigen::Vector3d p = g.terrain->point(s, d);
      Shot shot;
      shot.origin = (p + Eigen::Vector3d(0, 0, 5)).cast<float>();
      shot.direction = -Eigen::Vector3f::UnitZ();
      caster.cast({&shot, 1}, 20);
      ASSERT_TRUE(shot.hit);
      EXPECT_NEAR(shot.distance, 5, 0.03) << s << " " << d;
    }
  }
}

TEST(Terrain, TheKerbIsAStepUp) {
  const Ground g = make_ground(0);
  EXPECT_NEAR(g.terrain->height(10, 3.001) - g.terrain->height(10, 2.999), 0.12, 1e-3);
}

TEST(Terrain, AFrameOnTheGroundHasItsZAlongTheNormal) {
  const Ground g = make_ground(0);
  const SE3 T = g.terrain->on_ground(12, 10, 0.4);
  EXPECT_NEAR((T.linear() * T.linear().transpose() - Eigen::Matrix3d::Identity()).norm(), 0, 1e-9);
  EXPECT_NEAR(T.linear()(0, 2), -0.05, 0.02);  // up the grade, within the relief
  EXPECT_GT(T.linear()(2, 2), 0.99);
}

Terrain terrain_of(const TerrainShape& shape, std::uint64_t seed = 3, double kerb = 0.12) {
  core::Rng rng(seed);
  CrossSection section;
  for (auto* side : {&section.left, &section.right})
    *side = {{3, 0, Use::lane, 0, -0.02}, {20, 0, Use::sidewalk, kerb, 0.02}};
  return {shape, section, rng};
}

TerrainShape calm() {
  TerrainShape shape;
  shape.relief_m = shape.roughness_m = 0;
  return shape;
}

TEST(Terrain, AlongTheStreetTheGroundHasNoStep) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    TerrainShape shape;
    shape.relief_m = 0.25;
    shape.grade = 0.05;
    const Terrain terrain = terrain_of(shape, seed);
    for (const double d : {-12.0, -1.0, 0.5, 8.0}) {
      for (double s = -90; s < 90; s += 0.37)
        EXPECT_LT(std::abs(terrain.height(s + 0.01, d) - terrain.height(s, d)), 0.005) << s;
    }
  }
}

TEST(Terrain, AcrossTheStreetOnlyTheKerbIsAStep) {
  const Terrain terrain = terrain_of(calm());
  for (double d = -20; d < 20; d += 0.013) {
    const double step = std::abs(terrain.height(5, d + 0.01) - terrain.height(5, d));
    const bool kerb = std::abs(std::abs(d + 0.005) - 3) < 0.006;
    EXPECT_LT(step, kerb ? 0.125 : 0.001) << d;
  }
}

TEST(Terrain, BothSidesOfTheMiddleLineMeet) {
  const Terrain terrain = terrain_of({});
  for (double s = -80; s < 80; s += 3.1)
    EXPECT_NEAR(terrain.height(s, 1e-9), terrain.height(s, -1e-9), 1e-6);
}

TEST(Terrain, TheHeadingIsThatOfTheMiddleLine) {
  TerrainShape shape = calm();
  shape.bend_m = 4;
  shape.bend_period_m = 180;
  shape.bend_phase = 0.6;
  const Terrain terrain = terrain_of(shape);
  for (double s = -80; s < 80; s += 2.3) {
    const Eigen::Vector3d along = terrain.point(s + 1e-3, 0) - terrain.point(s - 1e-3, 0);
    EXPECT_NEAR(terrain.heading(s), std::atan2(along.y(), along.x()), 1e-6);
  }
}

TEST(Terrain, PointsBesideTheMiddleLineAreTheirDistanceFromIt) {
  TerrainShape shape = calm();
  shape.bend_m = 3;
  const Terrain terrain = terrain_of(shape);
  for (double s = -80; s < 80; s += 7) {
    for (const double d : {-9.0, -2.0, 2.0, 15.0}) {
      const Eigen::Vector3d apart = terrain.point(s, d) - terrain.point(s, 0);
      EXPECT_NEAR(apart.head<2>().norm(), std::abs(d), 1e-9);
    }
  }
}

TEST(Terrain, AnUprightFrameStandsOnTheGroundAndLooksAlongTheStreet) {
  const Ground g = make_ground(3);
  for (double s = -80; s < 80; s += 9) {
    const SE3 T = g.terrain->upright(s, 4, 0.3);
    EXPECT_EQ(T.translation(), g.terrain->point(s, 4));
    EXPECT_NEAR(T.linear()(2, 2), 1, 1e-12);
    EXPECT_NEAR(core::yaw(T.linear()), g.terrain->heading(s) + 0.3, 1e-9);
  }
}

TEST(Terrain, AFrameOnTheGroundIsARotationWhateverItsYaw) {
  const Ground g = make_ground(3);
  for (double yaw = -3; yaw < 3; yaw += 0.23) {
    const Eigen::Matrix3d R = g.terrain->on_ground(12, 10, yaw).linear();
    EXPECT_LT((R.transpose() * R - Eigen::Matrix3d::Identity()).norm(), 1e-9);
    EXPECT_NEAR(R.determinant(), 1, 1e-9);
  }
}

TEST(Terrain, WithoutReliefTheGradeIsAllOfIt) {
  TerrainShape shape = calm();
  shape.grade = 0.07;
  shape.side_slope = -0.03;
  const Terrain terrain = terrain_of(shape, 1, 0);
  EXPECT_NEAR(terrain.height(50, 0) - terrain.height(-50, 0), 7, 1e-9);
  EXPECT_NEAR(terrain.height(0, 13) - terrain.height(0, 8), 5 * (0.02 - 0.03), 1e-9);
}

TEST(Terrain, ItsWavesHaveTheConfiguredSpread) {
  for (const double relief : {0.05, 0.2}) {
    Spread height;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
      TerrainShape shape = calm();
      shape.relief_m = relief;
      const Terrain terrain = terrain_of(shape, seed);
      for (double s = -90; s < 90; s += 5) height.add(terrain.height(s, 0));
    }
    EXPECT_NEAR(height.sd(), relief, 0.12 * relief);
  }
}

TEST(Terrain, ACrossingIsLevelWithTheRoadAcrossAllStrips) {
  TerrainShape shape = calm();
  shape.crossing = 20;
  shape.crossing_half_width = 4;
  const Terrain terrain = terrain_of(shape);
  for (double d = -20; d < 20; d += 1.3) EXPECT_NEAR(terrain.height(20, d), 0, 1e-12);
  EXPECT_GT(terrain.height(30, 10), 0.1);
}

TEST(Terrain, ACrossingReachesItsHalfWidthAndTheMargin) {
  TerrainShape shape = calm();
  shape.crossing = 20;
  shape.crossing_half_width = 4;
  const Terrain terrain = terrain_of(shape);
  EXPECT_TRUE(terrain.in_crossing(23.9, 0));
  EXPECT_FALSE(terrain.in_crossing(24.1, 0));
  EXPECT_TRUE(terrain.in_crossing(24.9, 1));
  EXPECT_FALSE(terrain.in_crossing(14.9, 1));
}

TEST(Terrain, BeyondARampTheHeightStays) {
  TerrainShape shape = calm();
  shape.ramps.push_back({10, 30, 0.1});
  const Terrain terrain = terrain_of(shape);
  EXPECT_NEAR(terrain.height(5, 1) - terrain.height(-40, 1), 0, 1e-12);
  EXPECT_NEAR(terrain.height(20, 1) - terrain.height(5, 1), 1, 1e-12);
  EXPECT_NEAR(terrain.height(80, 1) - terrain.height(5, 1), 2, 1e-12);
}

TEST(Terrain, ARoughStripMeetsItsNeighboursWithoutAStep) {
  core::Rng rng(4);
  CrossSection section;
  for (auto* side : {&section.left, &section.right})
    *side = {{3, 0, Use::lane, 0, 0}, {6, 0, Use::lawn, 0, 0, 0.2}, {9, 0, Use::none, 0, 0}};
  const Terrain terrain(calm(), section, rng);
  Spread rough;
  for (double s = -80; s < 80; s += 0.7) {
    EXPECT_NEAR(terrain.height(s, 3), 0, 1e-9);
    EXPECT_NEAR(terrain.height(s, 9 - 1e-9), 0, 1e-6);
    rough.add(terrain.height(s, 6));
  }
  EXPECT_NEAR(rough.sd(), 0.2, 0.06);
}

TEST(Terrain, TheDrawnGroundHasTheSurfaceOfEachStrip) {
  const Ground g = make_ground(0);
  const RayCaster caster(g.world);
  for (double s = -80; s < 80; s += 11.3) {
    const auto surface = [&](double d) {
      return shoot(caster, g.terrain->point(s, d) + Eigen::Vector3d(0, 0, 3), {0, 0, -1}).material;
    };
    EXPECT_EQ(surface(1.5), g.palette.asphalt);
    EXPECT_EQ(surface(-1.5), g.palette.asphalt);
    EXPECT_EQ(surface(10), g.palette.paving);
    EXPECT_EQ(surface(-10), g.palette.paving);
  }
}

/// Under the kerb's face there is no gap: beams along the road meet it.
TEST(Terrain, TheKerbHasAFace) {
  const Ground g = make_ground(0);
  const RayCaster caster(g.world);
  for (double s = -40; s < 40; s += 7.7) {
    const double z = g.terrain->height(s, 2.99) + 0.05;
    const Shot shot = shoot(caster, {s, 2.6, z}, {0, 1, 0});
    ASSERT_TRUE(shot.hit);
    EXPECT_NEAR(place_of(shot).y(), 3, 0.01);
  }
}

TEST(Terrain, TheSameSeedGivesTheSameGroundAndAnotherAnother) {
  EXPECT_EQ(terrain_of({}, 4).height(17, 3), terrain_of({}, 4).height(17, 3));
  EXPECT_NE(terrain_of({}, 4).height(17, 3), terrain_of({}, 5).height(17, 3));
}

}  // namespace
}  // namespace saker::simulation
