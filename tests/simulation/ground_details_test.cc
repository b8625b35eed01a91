#include "saker/simulation/world/ground_details.h"

#include <gtest/gtest.h>

#include "drawn.h"

namespace saker::simulation {
namespace {

/// A straight street of constant slope along s and across, without waves.
struct Ground : Sketch {
  explicit Ground(double grade = 0, double side_slope = 0)
      : terrain(make(palette, grade, side_slope, rng)), painter(world, street, terrain) {}

  [[nodiscard]] double over_ground(const Eigen::Vector3f& p) const {
    return p.z() - terrain.height(p.x(), p.y());
  }
  [[nodiscard]] Eigen::AlignedBox3d box() const { return box_of(mesh()); }

  Terrain terrain;
  GroundPainter painter;

 private:
  static Terrain make(const Palette& palette, double grade, double side_slope, core::Rng& rng) {
    TerrainShape shape;
    shape.relief_m = shape.roughness_m = 0;
    shape.grade = grade;
    shape.side_slope = side_slope;
    CrossSection section;
    section.left = section.right = {{60, palette.asphalt, Use::lane, 0, 0}};
    return {shape, section, rng};
  }
};

TEST(GroundPainter, APatchLiesItsLiftAboveTheGround) {
  Ground g(0.1, -0.05);
  g.painter.patch(10, -4, 3, 1.5, g.palette.marking, 0.02);
  for (const Eigen::Vector3f& p : g.mesh().vertices) EXPECT_NEAR(g.over_ground(p), 0.02, 1e-5);
}

TEST(GroundPainter, APatchCoversItsRectangleOnce) {
  for (const auto& [half_s, half_d] :
       {std::pair(3.0, 1.5), std::pair(0.2, 0.3), std::pair(7.3, 0.6)}) {
    Ground g;
    g.painter.patch(10, -4, half_s, half_d, g.palette.marking);
    EXPECT_NEAR(area_of(g.mesh()), 4 * half_s * half_d, 1e-3);
    EXPECT_NEAR(g.box().min().x(), 10 - half_s, 1e-5);
    EXPECT_NEAR(g.box().max().y(), -4 + half_d, 1e-5);
  }
}

TEST(GroundPainter, ARoundBlotHasItsRadius) {
  Ground g;
  g.painter.blot(3, 1, 0.8, 0, g.street.steel, g.rng);
  EXPECT_NEAR(g.box().sizes().x(), 1.6, 1e-5);
  EXPECT_NEAR(area_of(g.mesh()), 7 * 0.64 * std::sin(2 * M_PI / 14), 1e-4);
}

TEST(GroundPainter, ARaggedBlotIsSmallerThanARoundOneAndWithinIt) {
  for (int i = 0; i < 20; ++i) {
    Ground g;
    g.painter.blot(3, 1, 1, 0.5, g.street.water, g.rng);
    for (const Eigen::Vector3f& p : g.mesh().vertices)
      EXPECT_LE((p.head<2>() - Eigen::Vector2f(3, 1)).norm(), 1 + 1e-5F);
    EXPECT_LT(area_of(g.mesh()), M_PI);
  }
}

TEST(GroundPainter, ASpeedBumpIsAsHighAndLongAsAsked) {
  Ground g;
  g.painter.speed_bump(20, -3, 3.5, 1.2, 0.09);
  EXPECT_NEAR(g.box().max().z(), 0.09 + 0.002, 1e-5);
  EXPECT_NEAR(g.box().sizes().x(), 1.2, 1e-5);
  EXPECT_NEAR(g.box().min().y(), -3, 1e-5);
  EXPECT_NEAR(g.box().max().y(), 3.5, 1e-5);
}

TEST(GroundPainter, ASpeedBumpBeginsAndEndsAtTheRoad) {
  Ground g;
  g.painter.speed_bump(20, -3, 3, 2, 0.1);
  for (const Eigen::Vector3f& p : g.mesh().vertices) {
    if (std::abs(std::abs(p.x() - 20) - 1) >= 1e-4F) continue;
    EXPECT_NEAR(p.z(), 0.002, 1e-5);
  }
}

TEST(GroundPainter, RailsAreTheirGaugeApart) {
  Ground g;
  g.painter.tram_track(1.6, -20, 20, 1.435);
  std::set<long> lines;
  for (const Eigen::Vector3f& p : g.mesh().vertices) lines.insert(std::lround(1000 * p.y()));
  ASSERT_EQ(lines.size(), 4U);  // two edges a rail
  const long first = *lines.begin(), last = *lines.rbegin();
  EXPECT_NEAR(static_cast<double>(last - first), 1435 + 80, 2);
  EXPECT_NEAR(0.0005 * static_cast<double>(first + last), 1.6, 0.002);
}

TEST(GroundPainter, ACrosswalkHasABarEveryMetreWithinTheRoad) {
  Ground g;
  g.painter.crosswalk(5, -3.2, 4.1);
  EXPECT_GE(g.box().min().y(), -3.2);
  EXPECT_LE(g.box().max().y(), 4.1);
  EXPECT_NEAR(g.box().sizes().x(), 3.2, 1e-5);
  const double bars = area_of(g.mesh()) / (3.2 * 0.5);
  EXPECT_NEAR(bars, 7, 1e-3);
}

TEST(GroundPainter, ALineIsDashedAsAsked) {
  Ground g;
  g.painter.line(0, -50, 50, 3, 6, 0.12);
  EXPECT_NEAR(area_of(g.mesh()) / (3 * 0.12), 11, 1e-3);  // dashes that fit
  EXPECT_NEAR(g.box().sizes().y(), 0.12, 1e-5);
  for (const MaterialId m : g.mesh().materials) EXPECT_EQ(m, g.palette.marking);
}

TEST(GroundPainter, AnIslandIsAStepHighAllAround) {
  Ground g;
  g.painter.island(10, 0, 4, 0.8, 0.15, g.palette.paving);
  const RayCaster caster(g.world);
  EXPECT_NEAR(place_of(shoot(caster, {10, 0, 5}, {0, 0, -1})).z(), 0.15, 1e-5);
  for (const Eigen::Vector3d& out : {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(-1, 0, 0),
                                     Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0, -1, 0)}) {
    const Eigen::Vector3d from = Eigen::Vector3d(10.3, 0.2, 0.07) + 8 * out;
    EXPECT_TRUE(shoot(caster, from, -out).hit) << out.transpose();
  }
}

TEST(GroundPainter, APathOnFlatGroundIsAPatch) {
  Ground g;
  g.painter.path(0, 4, 12, 0.8, g.palette.paving);
  EXPECT_NEAR(area_of(g.mesh()), 8 * 1.6, 1e-3);
  EXPECT_NEAR(g.box().min().y(), 4, 1e-5);
  EXPECT_NEAR(g.box().max().y(), 12, 1e-5);
}

TEST(GroundPainter, APathUpASteepSlopeHasLevelSteps) {
  Ground g(0, 0.4);
  g.painter.path(0, 4, 8, 0.8, g.palette.paving);
  const RayCaster caster(g.world);
  std::set<long> heights;
  for (double d = 4.02; d < 7.98; d += 0.01) {
    const Shot down = shoot(caster, {0.1, d, 10}, {0, 0, -1});
    ASSERT_TRUE(down.hit);
    heights.insert(std::lround(1000 * place_of(down).z()));
    EXPECT_GT(place_of(down).z(), g.terrain.height(0, d) - 0.02);
  }
  EXPECT_EQ(heights.size(), 11U);  // 4 m in treads of 0.35 m
}

TEST(Labelled, IsTheSameMaterialUnderAnotherLabel) {
  Sketch s;
  const MaterialId id = labelled(s.world, s.street.water, kSidewalk);
  EXPECT_EQ(s.world.materials[id].label, kSidewalk);
  EXPECT_EQ(s.world.materials[id].gloss, s.world.materials[s.street.water].gloss);
  EXPECT_EQ(s.world.materials[s.street.water].label, kRoad);
}

}  // namespace
}  // namespace saker::simulation
