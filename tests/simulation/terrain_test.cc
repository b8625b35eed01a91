#include "saker/simulation/world/terrain.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace saker::simulation
