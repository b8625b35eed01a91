#include "saker/simulation/world/furnish_street.h"

#include <gtest/gtest.h>

#include "made_site.h"
#include "saker/simulation/world/ground_details.h"

namespace saker::simulation {
namespace {

/// A street of a lane and one strip to each side, to be furnished.
struct MadeStreet : MadeSite {
  explicit MadeStreet(const StreetTheme& theme = {}, std::uint64_t seed = 1, double crossing = 1e9)
      : MadeSite({}, seed, crossing),
        street_flora(grow_street_flora(world, street, rng)),
        scene{site, street, street_flora, theme, rng} {}

  StreetFlora street_flora;
  StreetSite scene;
};

constexpr double kOften = 1.5;

TEST(FacingOutwards, XRunsAlongTheStreetAndYAwayFromIt) {
  const MadeStreet made;
  const Strip strip{4, 0, Use::sidewalk};
  for (const double side : {-1.0, 1.0}) {
    const SE3 T = facing_outwards(made.scene, made.lot(strip, side), 12, 0.5);
    EXPECT_NEAR(T.translation().x(), 12, 1e-9);
    EXPECT_NEAR(T.translation().y(), side * 5, 1e-9);
    EXPECT_NEAR(T.linear().col(1).y(), side, 1e-9);
    EXPECT_NEAR(std::abs(T.linear().col(0).x()), 1, 1e-9);
  }
}

TEST(CountOf, HasTheMeanThatWasAskedFor) {
  MadeStreet made;
  const Strip strip{4, 0, Use::sidewalk};
  for (const double per_100_m : {0.3, 5.0}) {
    Spread count;
    for (int i = 0; i < 4000; ++i)
      count.add(count_of(made.scene, made.lot(strip), per_100_m, kOften));
    EXPECT_NEAR(count.mean(), per_100_m * kOften * 1.8, 0.06 * per_100_m * kOften * 1.8 + 0.02);
  }
}

TEST(CountOf, AFactorOfZeroIsNone) {
  MadeStreet made;
  const Strip strip{4, 0, Use::sidewalk};
  for (int i = 0; i < 100; ++i) EXPECT_EQ(count_of(made.scene, made.lot(strip), 9, 0), 0);
}

TEST(RandomTheme, SomeStreetsHaveNoneOfAThing) {
  core::Rng rng(3);
  int bare = 0, trams = 0, winters = 0, works = 0;
  for (int i = 0; i < 2000; ++i) {
    const StreetTheme t = random_theme(rng);
    bare += t.plants == 0;
    trams += t.tram;
    winters += t.winter;
    works += t.works > 0;
    EXPECT_GE(t.plants, 0);
    EXPECT_LE(t.plants, 2.52);
    EXPECT_LE(t.stand_ins, 0.25);
  }
  EXPECT_NEAR(bare / 2000.0, 0.15, 0.03);
  EXPECT_NEAR(trams / 2000.0, 0.08, 0.02);
  EXPECT_NEAR(winters / 2000.0, 0.08, 0.02);
  EXPECT_NEAR(works / 2000.0, 0.25, 0.03);
}

TEST(StreetSite, InWinterNearlyAllTreesAreBare) {
  StreetTheme winter;
  winter.winter = true;
  EXPECT_GT(MadeStreet(winter).scene.nursery().bare_share, 0.9);
  EXPECT_LT(MadeStreet().scene.nursery().bare_share, 0.3);
}

TEST(FurnishWalk, WithoutPlantsPolesAndFurnitureAWalkStaysEmpty) {
  StreetTheme none;
  none.plants = none.furniture = none.poles = 0;
  MadeStreet made(none);
  const Strip strip{4, 0, Use::sidewalk};
  furnish_walk(made.scene, made.lot(strip));
  EXPECT_TRUE(made.mesh().triangles.empty());
  EXPECT_TRUE(made.world.placements.empty());
}

TEST(FurnishWalk, MorePolesAreMore) {
  const auto poles = [](double factor) {
    double area = 0;
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      StreetTheme theme;
      theme.plants = theme.furniture = 0;
      theme.poles = factor;
      MadeStreet made(theme, seed);
      const Strip strip{4, 0, Use::sidewalk};
      furnish_walk(made.scene, made.lot(strip));
      area += static_cast<double>(made.mesh().triangles.size());
    }
    return area;
  };
  EXPECT_GT(poles(2), 1.4 * poles(0.7));
}

TEST(FurnishSquare, FillsTheSquareAndNotTheLane) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    MadeStreet made({}, seed);
    const Strip strip{16, 0, Use::square};
    furnish_square(made.scene, made.lot(strip, 1, 6));
    EXPECT_GT(made.mesh().triangles.size(), 500U);
    EXPECT_GT(labels_of(made.world, made.mesh()).size(), 2U);
    EXPECT_TRUE(made.world.objects.empty()) << seed;
  }
}

TEST(FurnishGreen, AForestHasMoreTrunksThanAGarden) {
  const auto trunk_m2 = [](Use use) {
    double area = 0;
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
      MadeStreet made({}, seed);
      const Strip strip{20, 0, use};
      furnish_green(made.scene, made.lot(strip));
      area += area_of(made.mesh(),
                      [&](MaterialId m) { return made.world.materials[m].label == kTrunk; });
    }
    return area;
  };
  EXPECT_GT(trunk_m2(Use::forest), 1.5 * trunk_m2(Use::garden));
}

TEST(BuildBorder, RunsAlongTheWholeLot) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    MadeStreet made({}, seed);
    const Strip strip{0.8, 0, Use::border};
    build_border(made.scene, made.lot(strip, 1, 10), 0.5);
    Eigen::AlignedBox3d box = box_of(made.mesh());
    if (!made.world.placements.empty()) box.extend(box_of_placements(made.world));
    EXPECT_GT(box.sizes().x(), 100) << seed;
    EXPECT_GT(box.min().y(), 8) << seed;
    EXPECT_LT(box.max().y(), 13) << seed;
  }
}

TEST(BuildHouses, LeaveTheCrossingFree) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    MadeStreet made({}, seed, 5);
    const Strip strip{14, 0, Use::houses};
    build_houses(made.scene, made.lot(strip, 1, 8));
    const RayCaster caster(made.world);
    for (double x = 2; x < 8; x += 0.5)
      EXPECT_FALSE(shoot(caster, {x, 0, 1.5}, {0, 1, 0}, 20).hit) << seed;
  }
}

TEST(BuildHouses, StandInARow) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    MadeStreet made({}, seed);
    const Strip strip{14, 0, Use::houses};
    build_houses(made.scene, made.lot(strip, -1, 8));
    const RayCaster caster(made.world);
    int met = 0, all = 0;
    for (double x = -80; x < 70; x += 0.7) {
      ++all;
      met += shoot(caster, {x, 0, 2.4}, {0, -1, 0}, 26).hit;
    }
    EXPECT_GT(met, 0.5 * all) << seed;
  }
}

TEST(BuildIndustry, HasHallsOrDecksBehindItsYard) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    MadeStreet made({}, seed);
    const Strip strip{30, 0, Use::industry};
    build_industry(made.scene, made.lot(strip, 1, 8));
    const Eigen::AlignedBox3d halls = box_of_label(made.world, kBuilding);
    ASSERT_FALSE(halls.isEmpty());
    EXPECT_GT(halls.min().y(), 8 + 6 - 1.7) << seed;
    EXPECT_LT(halls.max().y(), 8 + 30.3) << seed;
  }
}

/// A street between sidewalks, without relief.
struct PaintedStreet : Sketch {
  explicit PaintedStreet(const StreetTheme& theme, std::uint64_t seed)
      : Sketch(seed),
        flora(grow_flora(world, palette, rng)),
        street_flora(grow_street_flora(world, street, rng)),
        terrain(ground(palette, rng)),
        site({world, palette, flora, terrain, {}, rng}),
        scene{site, street, street_flora, theme, rng} {
    paint_street(scene);
  }

  Flora flora;
  StreetFlora street_flora;
  Terrain terrain;
  Site site;
  StreetSite scene;

 private:
  static Terrain ground(const Palette& palette, core::Rng& rng) {
    TerrainShape shape;
    shape.relief_m = shape.roughness_m = 0;
    CrossSection section;
    section.left = section.right = {{4, palette.asphalt, Use::lane, 0, 0},
                                    {56, palette.paving, Use::sidewalk, 0, 0}};
    return {shape, section, rng};
  }
};

StreetTheme plain() {
  StreetTheme theme;
  theme.marked = false;
  return theme;
}

TEST(PaintStreet, MarkingsAreOnlyWhereStreetsAreMarked) {
  int marked = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    StreetTheme theme;
    const PaintedStreet with(theme, seed), without(plain(), seed);
    marked += labels_of(with.world, with.mesh()).contains(kLaneMarking);
    EXPECT_FALSE(labels_of(without.world, without.mesh()).contains(kLaneMarking)) << seed;
  }
  EXPECT_GT(marked, 5);
}

TEST(PaintStreet, WhatLiesOnTheRoadIsGroundWithinCentimetres) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const PaintedStreet made(plain(), seed);
    const Eigen::AlignedBox3d road = box_of_label(made.world, kRoad);
    if (road.isEmpty()) continue;
    EXPECT_GT(road.min().z(), -0.06) << seed;
    EXPECT_LT(road.max().z(), 0.2) << seed;
  }
}

TEST(PaintStreet, ATramsRailsRunAlongTheStreet) {
  StreetTheme theme = plain();
  theme.tram = true;
  const PaintedStreet made(theme, 2);
  const double steel = area_of(made.mesh(), [&](MaterialId m) { return m == made.street.steel; });
  EXPECT_GT(steel, 1.6 * 180 * 0.08);
  EXPECT_LT(steel, 4.4 * 180 * 0.08);
}

TEST(PaintStreet, PuddlesAreOnWetStreetsOnly) {
  double dry = 0, wet = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    StreetTheme theme = plain();
    const auto mirrors = [](const PaintedStreet& made) {
      return area_of(made.mesh(), [&](MaterialId m) {
        return made.world.materials[m].gloss > 0.98F && made.world.materials[m].transmission == 0;
      });
    };
    dry += mirrors(PaintedStreet(theme, seed));
    theme.wet = 1;
    wet += mirrors(PaintedStreet(theme, seed));
  }
  EXPECT_EQ(dry, 0);
  EXPECT_GT(wet, 10);
}

TEST(PaintStreet, SnowLiesInWinterOnly) {
  StreetTheme theme = plain();
  const auto snow = [](const PaintedStreet& made) {
    return area_of(made.mesh(), [&](MaterialId m) { return m == made.street.snow; });
  };
  EXPECT_EQ(snow(PaintedStreet(theme, 3)), 0);
  theme.winter = true;
  EXPECT_GT(snow(PaintedStreet(theme, 3)), 20);
}

}  // namespace
}  // namespace saker::simulation
