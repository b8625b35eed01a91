#include "saker/simulation/world/vehicle_parts.h"

#include <gtest/gtest.h>

#include "drawn.h"

namespace saker::simulation {
namespace {

/// The parts of one vehicle, to draw with.
struct Workshop : Sketch {
  explicit Workshop(std::uint64_t seed = 1)
      : Sketch(seed), parts(make_parts(world, palette, kTruck, rng)) {}

  [[nodiscard]] double area(MaterialId material) const {
    return area_of(mesh(), [&](MaterialId m) { return m == material; });
  }
  [[nodiscard]] Eigen::AlignedBox3d box(MaterialId material) const {
    return box_of(mesh(), [&](MaterialId m) { return m == material; });
  }

  Parts parts;
};

std::vector<MaterialId> all_of(const Parts& p) {
  return {p.paint, p.second, p.glass, p.interior, p.rubber, p.rim, p.plate, p.dark, p.chrome};
}

TEST(Parts, AllHaveTheLabelOfTheirVehicle) {
  for (const std::uint16_t label : {kCar, kBus, kTruck, kOtherVehicle, kVan, kMotorcycle}) {
    Sketch sketch;
    const Parts parts = make_parts(sketch.world, sketch.palette, label, sketch.rng);
    EXPECT_EQ(parts.label, label);
    for (const MaterialId m : all_of(parts)) EXPECT_EQ(sketch.world.materials[m].label, label);
  }
}

TEST(Parts, ReflectivitiesGlossesAndTransmissionsAreShares) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const Workshop w(seed);
    for (const MaterialId m : all_of(w.parts)) {
      const Material& material = w.world.materials[m];
      for (const float share : {material.reflectivity, material.gloss, material.transmission}) {
        EXPECT_GE(share, 0);
        EXPECT_LE(share, 1);
      }
    }
  }
}

TEST(Parts, OnlyGlassAndSpokesLetBeamsThrough) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const Workshop w(seed);
    for (const MaterialId m : all_of(w.parts)) {
      if (m == w.parts.glass || m == w.parts.rim) continue;
      EXPECT_EQ(w.world.materials[m].transmission, 0);
    }
  }
}

TEST(Parts, InABlackWorldPaintReturnsATwentiethAtMost) {
  Sketch sketch;
  sketch.palette.paint = Paint::black;
  for (int i = 0; i < 100; ++i) {
    const Parts parts = make_parts(sketch.world, sketch.palette, kCar, sketch.rng);
    EXPECT_LE(sketch.world.materials[parts.paint].reflectivity, 0.05F);
  }
}

TEST(Parts, PaintsRunFromNearlyBlackToNearlyWhite) {
  double darkest = 1, brightest = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const Workshop w(seed);
    const double reflectivity = w.world.materials[w.parts.paint].reflectivity;
    darkest = std::min(darkest, reflectivity);
    brightest = std::max(brightest, reflectivity);
  }
  EXPECT_LT(darkest, 0.05);
  EXPECT_GT(brightest, 0.7);
}

TEST(Parts, APaletteWithThemKeepsItsGroundsAndPlants) {
  const Workshop w;
  const Palette own = with_parts(w.palette, w.parts);
  EXPECT_EQ(own.rubber, w.parts.rubber);
  EXPECT_EQ(own.rim, w.parts.rim);
  EXPECT_EQ(own.interior, w.parts.interior);
  EXPECT_EQ(own.plate, w.parts.plate);
  EXPECT_EQ(own.dark, w.parts.dark);
  EXPECT_EQ(own.asphalt, w.palette.asphalt);
  EXPECT_EQ(own.leaves, w.palette.leaves);
}

TEST(DrawPrism, IsClosedBetweenItsTwoOutlines) {
  Workshop w;
  draw_prism(w.pen(), {{0, 0}, {2, 0}, {2, 1}, {1, 1.5}, {0, 1}}, -0.3, 0.8, w.parts.paint);
  EXPECT_EQ(open_edges(w.mesh()), 0);
  const Eigen::AlignedBox3d box = box_of(w.mesh());
  EXPECT_NEAR(box.min().y(), -0.3, 1e-6);
  EXPECT_NEAR(box.max().y(), 0.8, 1e-6);
  EXPECT_NEAR(box.max().z(), 1.5, 1e-6);
}

TEST(DrawBar, IsAsLongAsTheWayAndAsThickAsAsked) {
  Workshop w;
  draw_bar(w.pen(), {1, 0, 0}, {4, 0, 0}, 0.2, w.parts.dark);
  const Eigen::AlignedBox3d box = box_of(w.mesh());
  EXPECT_NEAR(box.sizes().x(), 3, 1e-6);
  EXPECT_LE(box.sizes().y(), 0.2 + 1e-6);
  EXPECT_GT(box.sizes().y(), 0.18);
  EXPECT_EQ(open_edges(w.mesh()), 0);
}

TEST(DrawAxle, ItsTyresStandOnTheGround) {
  for (const double radius : {0.26, 0.48, 0.75}) {
    Workshop w;
    draw_axle(w.pen(), {2, 1.2, radius, 0.3, false}, w.parts);
    const Eigen::AlignedBox3d tyres = w.box(w.parts.rubber);
    EXPECT_NEAR(tyres.min().z(), 0, 0.02 * radius);
    EXPECT_NEAR(tyres.max().z(), 2 * radius, 0.02 * radius);
    EXPECT_NEAR(tyres.center().x(), 2, 1e-3);
  }
}

TEST(DrawAxle, ItsTyresReachToTheHalfWidth) {
  Workshop w;
  draw_axle(w.pen(), {0, 1.2, 0.5, 0.3, false}, w.parts);
  EXPECT_NEAR(w.box(w.parts.rubber).max().y(), 1.2, 1e-6);
  EXPECT_NEAR(w.box(w.parts.rubber).min().y(), -1.2, 1e-6);
}

TEST(DrawAxle, ATwinHasTwiceTheTyres) {
  Workshop single, twin;
  draw_axle(single.pen(), {0, 1.2, 0.5, 0.3, false}, single.parts);
  draw_axle(twin.pen(), {0, 1.2, 0.5, 0.3, true}, twin.parts);
  EXPECT_NEAR(twin.area(twin.parts.rubber), 2 * single.area(single.parts.rubber), 1e-4);
}

TEST(DrawAxle, BothSidesAreAlike) {
  Workshop w;
  draw_axle(w.pen(), {0, 1.2, 0.5, 0.3, true}, w.parts);
  const Eigen::AlignedBox3d box = box_of(w.mesh());
  EXPECT_NEAR(box.min().y(), -box.max().y(), 1e-6);
  EXPECT_NEAR(w.box(w.parts.rim).max().y(), 1.206, 1e-5);
}

TEST(DrawGlazedSide, WallAndGlassCoverTheSideOnce) {
  const WallHeights heights{0.3, 1.1, 2.0, 2.6};
  for (const Panes& panes :
       {Panes{}, Panes{{0.5, 1.5}}, Panes{{0, 1}, {1, 2}}, Panes{{0.2, 0.9}, {1.4, 3.9}}}) {
    Workshop w;
    draw_glazed_side(w.pen(), 0, 4, 1, heights, panes, w.parts);
    EXPECT_NEAR(area_of(w.mesh()), 4 * 2.3, 1e-4);
    double glass = 0;
    for (const auto& [from, to] : panes) glass += (to - from) * (2.0 - 1.1);
    EXPECT_NEAR(w.area(w.parts.glass), glass, 1e-4);
  }
}

TEST(DrawGlazedSide, StandsInOnePlane) {
  Workshop w;
  draw_glazed_side(w.pen(), -1, 4, -1.25, {0, 1, 2, 3}, {{0, 1}}, w.parts);
  EXPECT_NEAR(box_of(w.mesh()).sizes().y(), 0, 1e-6);
  EXPECT_NEAR(box_of(w.mesh()).min().y(), -1.25, 1e-6);
}

TEST(DrawGlazedEnd, HasOnePaneBetweenSillAndLintel) {
  Workshop w;
  draw_glazed_end(w.pen(), {2, 2, 1.9, 1.8}, 1.2, {0.3, 1.0, 2.2, 2.6}, w.parts);
  const Eigen::AlignedBox3d pane = w.box(w.parts.glass);
  EXPECT_NEAR(pane.min().z(), 1.0, 1e-6);
  EXPECT_NEAR(pane.max().z(), 2.2, 1e-6);
  EXPECT_NEAR(pane.sizes().y(), 2 * (1.2 - 0.09), 1e-6);
  EXPECT_NEAR(box_of(w.mesh()).sizes().y(), 2.4, 1e-6);
}

TEST(DrawLadderFrame, ItsUpperEdgeIsWhereItWasAsked) {
  Workshop w;
  draw_ladder_frame(w.pen(), -4, 3, 0.95, w.parts);
  const Eigen::AlignedBox3d box = box_of(w.mesh());
  EXPECT_NEAR(box.max().z(), 0.95, 1e-6);
  EXPECT_NEAR(box.min().x(), -4, 1e-6);
  EXPECT_LT(box.sizes().y(), 1);
}

TEST(DrawGuards, AreNarrowerThanTheVehicle) {
  Workshop w;
  draw_guards(w.pen(), -5, -3, 0, 1.25, w.parts);
  const Eigen::AlignedBox3d box = box_of(w.mesh());
  EXPECT_LT(box.max().y(), 1.25);
  EXPECT_GT(box.min().y(), -1.25);
  EXPECT_GE(box.min().x(), -5);
}

TEST(DrawGuards, WithoutRoomForSideBarsOnlyTheRearOneIsThere) {
  Workshop w;
  draw_guards(w.pen(), -5, -3, -2.8, 1.25, w.parts);
  EXPECT_EQ(w.area(w.parts.chrome), 0);
  EXPECT_LT(box_of(w.mesh()).max().x(), -4.8);
}

TEST(DrawMirrors, StandOutToBothSides) {
  Workshop w;
  draw_mirrors(w.pen(), 2, 1.2, 1.5, 2.1, w.parts);
  const Eigen::AlignedBox3d box = box_of(w.mesh());
  EXPECT_NEAR(box.max().y(), 1.46, 1e-6);
  EXPECT_NEAR(box.min().y(), -1.46, 1e-6);
  EXPECT_NEAR(box.max().z(), 2.1, 1e-6);
}

TEST(DrawSeat, ItsBackStandsBehindTheSeat) {
  Workshop w;
  draw_seat(w.pen(), 0.5, 1.1, w.parts.interior);
  const Eigen::AlignedBox3d box = box_of(w.mesh());
  EXPECT_NEAR(box.max().z(), 1.1, 1e-6);
  EXPECT_NEAR(box.sizes().y(), 0.5, 1e-6);
  const RayCaster caster(w.world);
  EXPECT_NEAR(place_of(shoot(caster, {3, 0, 0.9}, {-1, 0, 0})).x(), -0.2, 1e-4);
}

}  // namespace
}  // namespace saker::simulation
