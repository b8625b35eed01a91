#include "saker/simulation/world/buildings.h"

#include <gtest/gtest.h>

#include "drawn.h"
#include "saker/simulation/world/facades.h"

namespace saker::simulation {
namespace {

/// One building whose front runs along x from the origin.
struct Built : Sketch {
  Built(const BuildingShape& s, std::uint64_t seed) : Sketch(seed), shape(s) {
    add_building(world, palette, shape, SE3::Identity(), rng);
  }
  BuildingShape shape;
};

template <class Check>
void for_each_building(Check check) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE(seed);
    core::Rng rng(seed);
    check(Built(random_building(rng, seed % 2 == 0), seed));
  }
}

TEST(Building, ItsWallsStandOnItsOutline) {
  for_each_building([](const Built& b) {
    const RayCaster caster(b.world);
    const double z = 0.5 * b.shape.storey_height + 0.6, d = b.shape.depth, w = b.shape.width;
    EXPECT_NEAR(place_of(shoot(caster, {-9, d / 2, z}, {1, 0, 0})).x(), 0, 1e-4);
    EXPECT_NEAR(place_of(shoot(caster, {w + 9, d / 2, z}, {-1, 0, 0})).x(), w, 1e-4);
    EXPECT_NEAR(place_of(shoot(caster, {w / 2, d + 9, z}, {0, -1, 0})).y(), d, 1e-4);
  });
}

TEST(Building, FromItsFrontABeamGoesNoDeeperThanARoom) {
  for_each_building([](const Built& b) {
    const RayCaster caster(b.world);
    for (double x = 0.3; x < b.shape.width - 0.2; x += 0.21) {
      for (double z = 0.1; z < b.shape.storeys * b.shape.storey_height - 0.1; z += 0.23) {
        const std::vector<Shot> met = surfaces_along(caster, {x, -9, z}, {0, 1, 0});
        ASSERT_FALSE(met.empty()) << x << " " << z;
        EXPECT_LT(place_of(met.front()).y(), 0.3) << x << " " << z;
      }
    }
  });
}

TEST(Building, ItIsAsHighAsItsStoreysAndItsRoof) {
  for_each_building([](const Built& b) {
    if (b.shape.storeys < 2) return;  // a bay window may be higher
    const double eaves = b.shape.storeys * b.shape.storey_height;
    const double roof = b.shape.gable ? 0.38 * b.shape.depth : 0.25;
    EXPECT_NEAR(box_of(b.mesh()).max().z(), eaves + roof, 1e-3);
  });
}

TEST(Building, AGableIsHighestOverItsMiddle) {
  BuildingShape shape;
  shape.gable = true;
  const Built b(shape, 3);
  const RayCaster caster(b.world);
  const auto roof = [&](double y) { return place_of(shoot(caster, {6, y, 60}, {0, 0, -1})).z(); };
  EXPECT_NEAR(roof(5), 3 * 2.9 + 0.38 * 10, 0.02);
  EXPECT_LT(roof(1), roof(3));
  EXPECT_NEAR(roof(2), roof(8), 0.01);
}

TEST(Building, AFlatRoofIsLevel) {
  const Built b({}, 3);
  const RayCaster caster(b.world);
  for (double y = 0.5; y < 10; y += 1)
    EXPECT_NEAR(place_of(shoot(caster, {6, y, 60}, {0, 0, -1})).z(), 3 * 2.9 + 0.25, 1e-4);
}

TEST(Building, EveryTriangleIsBuilding) {
  for_each_building([](const Built& b) {
    EXPECT_EQ(labels_of(b.world, b.mesh()), std::set<int>{kBuilding});
    EXPECT_TRUE(b.world.objects.empty());
  });
}

TEST(Building, HasWindowsOfGlassOnEveryStorey) {
  for_each_building([](const Built& b) {
    std::set<int> storeys;
    for (std::size_t i = 0; i < b.mesh().triangles.size(); ++i) {
      if (b.mesh().materials[i] != b.palette.glass) continue;
      const double z = b.mesh().vertices[b.mesh().triangles[i][0]].z();
      storeys.insert(static_cast<int>(z / b.shape.storey_height));
    }
    EXPECT_GE(static_cast<double>(storeys.size()), b.shape.storeys - 1);
  });
}

TEST(Building, AShopHasMoreGlassOnItsGroundFloor) {
  BuildingShape plain, shop;
  plain.storeys = shop.storeys = 1;
  shop.shop = true;
  double plain_m2 = 0, shop_m2 = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Built a(plain, seed), b(shop, seed);
    plain_m2 += area_of(a.mesh(), [&](MaterialId m) { return m == a.palette.glass; });
    shop_m2 += area_of(b.mesh(), [&](MaterialId m) { return m == b.palette.glass; });
  }
  EXPECT_GT(shop_m2, 1.5 * plain_m2);
}

TEST(Building, BalconiesStandOutOfItsFront) {
  BuildingShape shape;
  shape.balcony_share = 1;
  EXPECT_NEAR(box_of(Built(shape, 2).mesh()).min().y(), -1.3, 0.25);
}

TEST(RandomBuilding, DetachedOnesAreLowAndOthersStandHigher) {
  core::Rng rng(7);
  Spread detached, row;
  for (int i = 0; i < 500; ++i) {
    detached.add(random_building(rng, true).storeys);
    row.add(random_building(rng, false).storeys);
  }
  EXPECT_NEAR(detached.mean(), 2, 0.15);
  EXPECT_NEAR(row.mean(), 3.5, 0.2);
}

TEST(RandomBuilding, OnlyThoseInARowHaveShops) {
  core::Rng rng(7);
  for (int i = 0; i < 300; ++i) EXPECT_FALSE(random_building(rng, true).shop);
}

TEST(House, IsOnlyBuildingAndSigns) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Sketch s(seed);
    add_house(s.world, s.street, random_building(s.rng, true), SE3::Identity(), s.rng);
    for (const int label : labels_of(s.world, s.mesh()))
      EXPECT_TRUE(label == kBuilding || label == kTrafficSign) << label;
  }
}

TEST(House, ItsFoundationGoesIntoTheGround) {
  Sketch s;
  add_house(s.world, s.street, {}, SE3::Identity(), s.rng);
  EXPECT_LT(box_of(s.mesh()).min().z(), -3.9);
}

TEST(House, WhatStandsBeforeItsFrontReachesAFewMetresAtMost) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    Sketch s(seed);
    add_house(s.world, s.street, random_building(s.rng, false), SE3::Identity(), s.rng);
    EXPECT_GT(box_of(s.mesh()).min().y(), -4) << seed;
  }
}

TEST(Arcade, OneLooksBetweenItsColumns) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Sketch s(seed);
    BuildingShape shape;
    shape.width = 16;
    add_arcade(s.world, s.street, shape, SE3::Identity(), s.rng);
    const RayCaster caster(s.world);
    int column = 0, behind = 0;
    for (double x = 0.1; x < 15.9; x += 0.05) {
      const double y = place_of(shoot(caster, {x, -9, 1.5}, {0, 1, 0})).y();
      column += y < 0.6;
      behind += y > 1.5;
    }
    EXPECT_GT(column, 10) << seed;
    EXPECT_GT(behind, 100) << seed;
  }
}

TEST(Hall, IsClosedToItsHeight) {
  Sketch s;
  add_hall(s.world, s.street, 30, 20, 8, SE3::Identity(), s.rng);
  const RayCaster caster(s.world);
  EXPECT_NEAR(place_of(shoot(caster, {15, 10, 30}, {0, 0, -1})).z(), 8, 1e-4);
  for (double x = 0.5; x < 30; x += 0.5) EXPECT_TRUE(shoot(caster, {x, -9, 6}, {0, 1, 0}).hit);
}

TEST(Shed, HasARoofThatSheds) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Sketch s(seed);
    add_shed(s.world, s.street, SE3::Identity(), s.rng);
    const RayCaster caster(s.world);
    const double front = place_of(shoot(caster, {0, -0.8, 9}, {0, 0, -1})).z();
    const double back = place_of(shoot(caster, {0, 0.8, 9}, {0, 0, -1})).z();
    EXPECT_GT(back, front + 0.1) << seed;
    EXPECT_GT(front, 1.9) << seed;
  }
}

TEST(Deck, OneParksUnderItAndOnIt) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Sketch s(seed);
    add_deck(s.world, s.street, 24, 12, SE3::Identity(), s.rng);
    const RayCaster caster(s.world);
    const Shot up = shoot(caster, {12.2, 6, 0.1}, {0, 0, 1}),
               down = shoot(caster, {12.2, 6, 20}, {0, 0, -1});
    EXPECT_GT(place_of(up).z(), 2.25) << seed;
    EXPECT_NEAR(place_of(down).z(), place_of(up).z() + 0.35, 1e-4) << seed;
  }
}

TEST(Bridge, LorriesPassUnderItBetweenItsAbutments) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Sketch s(seed);
    add_bridge(s.world, s.street, 20, SE3::Identity(), s.rng);
    const RayCaster caster(s.world);
    for (double y = -9.9; y < 9.9; y += 0.7) {
      const Shot up = shoot(caster, {0, y, 0.1}, {0, 0, 1});
      ASSERT_TRUE(up.hit);
      EXPECT_GT(place_of(up).z(), 4.5) << seed;
      EXPECT_FALSE(shoot(caster, {-30, y, 3}, {1, 0, 0}).hit) << y;
    }
    EXPECT_TRUE(shoot(caster, {-30, 10.5, 3}, {1, 0, 0}).hit) << seed;
    EXPECT_TRUE(shoot(caster, {-30, -10.5, 3}, {1, 0, 0}).hit) << seed;
  }
}

}  // namespace
}  // namespace saker::simulation
