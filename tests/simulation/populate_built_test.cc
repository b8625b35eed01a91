#include <gtest/gtest.h>

#include "made_site.h"

namespace saker::simulation {
namespace {

Population cluttered(double clutter) {
  Population p;
  p.clutter = clutter;
  p.lamp_spacing = 20;
  return p;
}

/// Kinds of the poles in the truth, of several sidewalks.
std::map<std::string, int> poles_of(const Population& population, int sidewalks) {
  std::map<std::string, int> kinds;
  for (int seed = 1; seed <= sidewalks; ++seed) {
    MadeSite made(population, static_cast<std::uint64_t>(seed));
    const Strip strip{3, 0, Use::sidewalk};
    build_sidewalk(made.site, made.lot(strip));
    for (const TrueObject& object : made.world.objects) ++kinds[object.kind];
  }
  return kinds;
}

TEST(Sidewalk, LampsStandInARowAtTheirSpacing) {
  int rows = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    MadeSite made(cluttered(0), seed);
    const Strip strip{3, 0, Use::sidewalk};
    build_sidewalk(made.site, made.lot(strip));
    std::vector<Eigen::Vector3d> roots;
    for (const TrueObject& object : made.world.objects)
      roots.push_back(std::get<objects::Cylinder>(object.model).root);
    if (roots.size() < 3) continue;
    ++rows;
    for (std::size_t i = 1; i < roots.size(); ++i) {
      EXPECT_NEAR(std::remainder(roots[i].x() - roots[i - 1].x(), 20), 0, 1e-6);
      EXPECT_NEAR(roots[i].y(), roots[0].y(), 1e-6);
    }
  }
  EXPECT_GT(rows, 5);
}

TEST(Sidewalk, WithoutClutterThereAreNoSigns) {
  const auto kinds = poles_of(cluttered(0), 10);
  EXPECT_FALSE(kinds.contains("sign"));
  EXPECT_TRUE(kinds.contains("lamp"));
}

TEST(Sidewalk, TwiceTheClutterIsTwiceTheSigns) {
  const double once = poles_of(cluttered(1), 40).at("sign");
  const double twice = poles_of(cluttered(2), 40).at("sign");
  EXPECT_NEAR(twice / once, 2, 0.4);
}

TEST(Sidewalk, SomeLampsAreTrafficLights) {
  const auto kinds = poles_of(cluttered(0), 60);
  EXPECT_GT(kinds.at("traffic light"), 0);
  EXPECT_GT(kinds.at("lamp"), 5 * kinds.at("traffic light"));
}

TEST(Sidewalk, StreetTreesStandInTheirSpacingWhereThereAreAny) {
  Population population = cluttered(0);
  population.tree_spacing = 9;
  population.street_trees = true;
  MadeSite with(population);
  const Strip strip{3, 0, Use::sidewalk};
  build_sidewalk(with.site, with.lot(strip));
  EXPECT_GT(with.objects_of("trunk"), 15);
  population.street_trees = false;
  MadeSite without(population);
  build_sidewalk(without.site, without.lot(strip));
  EXPECT_EQ(without.objects_of("trunk"), 0);
}

TEST(Sidewalk, NothingStandsInTheCrossing) {
  Population population = cluttered(3);
  population.street_trees = true;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    MadeSite made(population, seed, 10);
    const Strip strip{3, 0, Use::sidewalk};
    build_sidewalk(made.site, made.lot(strip));
    for (const TrueObject& object : made.world.objects)
      EXPECT_GT(std::abs(objects::place(object.model).x() - 10), 4) << seed;
  }
}

TEST(Buildings, FormARowAlongTheLot) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    MadeSite made(cluttered(0), seed);
    const Strip strip{14, 0, Use::buildings};
    build_buildings(made.site, made.lot(strip, 1, 10));
    const RayCaster caster(made.world);
    int met = 0, all = 0;
    for (double x = -80; x < 80; x += 0.5) {
      ++all;
      met += shoot(caster, {x, 0, 2}, {0, 1, 0}).hit;
    }
    EXPECT_GT(met, 0.5 * all) << seed;
  }
}

TEST(Buildings, FacingTheStreetFromBothSides) {
  for (const double side : {-1.0, 1.0}) {
    MadeSite made(cluttered(0), 3);
    const Strip strip{14, 0, Use::buildings};
    build_buildings(made.site, made.lot(strip, side, 10));
    const Eigen::AlignedBox3d box = box_of_label(made.world, kBuilding);
    const double nearest = side > 0 ? box.min().y() : -box.max().y();
    EXPECT_GT(nearest, 7);
    EXPECT_LT(nearest, 14);
  }
}

TEST(Buildings, LeaveTheCrossingFree) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    MadeSite made(cluttered(0), seed, -15);
    const Strip strip{14, 0, Use::buildings};
    build_buildings(made.site, made.lot(strip, 1, 10));
    const RayCaster caster(made.world);
    for (double x = -18.5; x < -11.5; x += 0.5)
      EXPECT_FALSE(shoot(caster, {x, 0, 2}, {0, 1, 0}, 22).hit) << seed;
  }
}

}  // namespace
}  // namespace saker::simulation
