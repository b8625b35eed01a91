#include "saker/simulation/world/vehicle_cab.h"

#include <gtest/gtest.h>

#include "drawn.h"

namespace saker::simulation {
namespace {

/// One cab over the engine, its front end at x = 1.
struct Cab : Sketch {
  explicit Cab(bool back_wall = true, double nose = 0.03) : parts(make(world, palette, rng)) {
    shape.front = 1;
    shape.nose = nose;
    shape.back_wall = back_wall;
    draw_cab(pen(), shape, parts);
  }

  [[nodiscard]] Eigen::AlignedBox3d box(MaterialId material) const {
    return box_of(mesh(), [&](MaterialId m) { return m == material; });
  }

  CabShape shape;
  Parts parts;

 private:
  static Parts make(World& world, const Palette& palette, core::Rng& rng) {
    return make_parts(world, palette, kTruck, rng);
  }
};

TEST(DrawCab, ReachesFromItsFrontEndToItsBackWall) {
  const Cab cab;
  const Eigen::AlignedBox3d box = box_of(cab.mesh());
  EXPECT_NEAR(box.max().x(), 1, 1e-6);
  EXPECT_NEAR(box.min().x(), 1 - cab.shape.length, 1e-6);
}

TEST(DrawCab, ReachesFromItsBumperToItsRoof) {
  const Cab cab;
  const Eigen::AlignedBox3d box = box_of(cab.mesh());
  EXPECT_NEAR(box.min().z(), cab.shape.low, 1e-6);
  EXPECT_NEAR(box.max().z(), cab.shape.height, 1e-6);
}

TEST(DrawCab, BothSidesAreAlike) {
  constexpr double kBar = 1e-2;  // m: the arms of the mirrors are drawn with five sides
  EXPECT_TRUE(is_mirrored(Cab().mesh(), kBar));
  EXPECT_TRUE(is_mirrored(Cab(true, 1.2).mesh(), kBar));
}

TEST(DrawCab, ABeamFromAheadMeetsTheWindscreenBetweenBeltAndLintel) {
  const Cab cab;
  const RayCaster caster(cab.world);
  for (double z = cab.shape.belt + 0.05; z < cab.shape.lintel; z += 0.1) {
    const Shot shot = shoot(caster, {6, 0.1, z}, {-1, 0, 0});
    ASSERT_TRUE(shot.hit);
    EXPECT_EQ(shot.material, cab.parts.glass) << z;
  }
}

TEST(DrawCab, TheWindscreenLeansBackwards) {
  const Cab cab;
  const RayCaster caster(cab.world);
  const double low = place_of(shoot(caster, {6, 0, cab.shape.belt + 0.02}, {-1, 0, 0})).x();
  const double high = place_of(shoot(caster, {6, 0, cab.shape.lintel - 0.02}, {-1, 0, 0})).x();
  EXPECT_NEAR(low - high, cab.shape.rake, 0.02);
}

TEST(DrawCab, ABeamFromTheSideMeetsTheSideWindow) {
  const Cab cab;
  const RayCaster caster(cab.world);
  const double middle = 1 - cab.shape.nose - cab.shape.rake - 0.5 * cab.shape.window;
  const double z = 0.5 * (cab.shape.belt + cab.shape.lintel);
  for (const double side : {-1.0, 1.0}) {
    const Shot shot = shoot(caster, {middle, side * 6, z}, {0, -side, 0});
    EXPECT_EQ(shot.material, cab.parts.glass);
    EXPECT_NEAR(std::abs(place_of(shot).y()), cab.shape.half_width, 1e-4);
  }
}

TEST(DrawCab, NoBeamFromAheadPassesBelowTheBelt) {
  const Cab cab;
  const RayCaster caster(cab.world);
  for (double y = -1.1; y <= 1.1; y += 0.1) {
    for (double z = cab.shape.low + 0.02; z < cab.shape.bonnet; z += 0.1) {
      const Shot shot = shoot(caster, {6, y, z}, {-1, 0, 0});
      ASSERT_TRUE(shot.hit);
      EXPECT_GT(place_of(shot).x(), 0.85);
    }
  }
}

TEST(DrawCab, WithoutABackWallOneSeesTheSeatsFromBehind) {
  const Cab open(false), closed;
  const double z = open.shape.belt + 0.1, y = 0.55 * open.shape.half_width;
  const double back = 1 - open.shape.length;
  const RayCaster into_open(open.world), onto_closed(closed.world);
  EXPECT_EQ(shoot(into_open, {back - 3, y, z}, {1, 0, 0}).material, open.parts.interior);
  EXPECT_NEAR(place_of(shoot(onto_closed, {back - 3, y, z}, {1, 0, 0})).x(), back, 1e-4);
}

TEST(DrawCab, ABonnetIsBeforeTheWindscreen) {
  const Cab cab(true, 1.2);
  const RayCaster caster(cab.world);
  const Shot down = shoot(caster, {0.5, 0, 5}, {0, 0, -1});
  EXPECT_EQ(down.material, cab.parts.paint);
  EXPECT_LT(place_of(down).z(), cab.shape.belt + 1e-3);
  EXPECT_GT(place_of(down).z(), cab.shape.bonnet - 1e-3);
}

TEST(DrawCab, ThePlateIsAtTheFrontEnd) {
  const Cab cab;
  const Eigen::AlignedBox3d plate = cab.box(cab.parts.plate);
  EXPECT_NEAR(plate.max().x(), 1, 1e-6);
  EXPECT_NEAR(plate.sizes().y(), 0.52, 1e-6);
  EXPECT_LT(plate.max().z(), 1);
}

TEST(DrawCab, OnlyTheMirrorsStandOutOfItsWidth) {
  const Cab cab;
  const Eigen::AlignedBox3d paint = cab.box(cab.parts.paint);
  EXPECT_NEAR(paint.max().y(), cab.shape.half_width, 1e-6);
  EXPECT_NEAR(box_of(cab.mesh()).max().y(), cab.shape.half_width + 0.26, 1e-6);
}

}  // namespace
}  // namespace saker::simulation
