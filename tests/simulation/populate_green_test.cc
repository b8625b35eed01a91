#include <gtest/gtest.h>

#include "made_site.h"

namespace saker::simulation {
namespace {

Population green(double greenery = 1) {
  Population p;
  p.greenery = greenery;
  p.parked = 0;
  p.clutter = 0;
  return p;
}

using Builder = void (*)(Site&, const Lot&);

/// What a builder makes of a lot 10 m wide, in means over eight of them.
struct Made {
  double trunks = 0, bushes = 0, hedges = 0, poles = 0, vehicles = 0;
};

Made made_by(Builder build, const Population& population, double width = 10) {
  Made sum;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    MadeSite made(population, seed);
    const Strip strip{width, 0, Use::lawn};
    build(made.site, made.lot(strip, 1, 5));
    sum.trunks += made.objects_of("trunk") / 8.0;
    sum.poles += made.objects_of("pole") / 8.0;
    sum.vehicles += made.objects_of("vehicle") / 8.0;
    sum.bushes += made.placed_of(made.flora.bushes) / 8.0;
    sum.hedges += made.placed_of(made.flora.hedges) / 8.0;
  }
  return sum;
}

TEST(Green, AForestHasMoreTreesThanALawn) {
  EXPECT_GT(made_by(build_forest, green()).trunks, 2 * made_by(build_lawn, green()).trunks);
}

TEST(Green, TwiceTheGreeneryIsMoreBushesAndTrees) {
  const Made once = made_by(build_lawn, green(0.5)), twice = made_by(build_lawn, green(1));
  EXPECT_NEAR(twice.bushes / once.bushes, 2, 0.8);
  EXPECT_NEAR(twice.trunks / once.trunks, 2, 0.8);
}

TEST(Green, WithoutGreeneryALawnIsEmpty) {
  const Made none = made_by(build_lawn, green(0));
  EXPECT_EQ(none.bushes, 0);
  EXPECT_LT(none.trunks, 0.1);
}

TEST(Green, AThicketIsFullOfBushes) { EXPECT_GT(made_by(build_thicket, green()).bushes, 100); }

TEST(Green, AnIslandHasTreesAndSomeLamps) {
  const Made island = made_by(build_island, green(), 2);
  EXPECT_GT(island.trunks, 5);
  EXPECT_GT(island.poles, 1);
  EXPECT_GT(island.trunks, island.poles);
}

TEST(Green, ATreeRowStandsOnItsStrip) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    MadeSite made(green(), seed);
    const Strip strip{3, 0, Use::tree_row};
    build_tree_row(made.site, made.lot(strip, -1, 5));
    for (const TrueObject& object : made.world.objects) {
      const double y = objects::place(object.model).y();
      EXPECT_LT(y, -5) << seed;
      EXPECT_GT(y, -8) << seed;
    }
    EXPECT_GT(made.objects_of("trunk"), 8) << seed;
  }
}

TEST(Green, TreesDoNotStandInEachOther) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    MadeSite made(green(2), seed);
    const Strip strip{25, 0, Use::forest};
    build_forest(made.site, made.lot(strip, 1, 5));
    std::vector<const objects::Cylinder*> trunks;
    for (const TrueObject& object : made.world.objects)
      trunks.push_back(&std::get<objects::Cylinder>(object.model));
    for (std::size_t i = 0; i < trunks.size(); ++i) {
      for (std::size_t k = 0; k < i; ++k)
        EXPECT_GT((trunks[i]->root - trunks[k]->root).norm(),
                  trunks[i]->radius + trunks[k]->radius + 0.3);
    }
  }
}

TEST(Green, NothingGrowsOutOfItsLot) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    MadeSite made(green(2), seed);
    const Strip strip{12, 0, Use::forest};
    build_forest(made.site, made.lot(strip, 1, 20));
    for (const TrueObject& object : made.world.objects) {
      EXPECT_GT(objects::place(object.model).y(), 20) << seed;
      EXPECT_LT(objects::place(object.model).y(), 32) << seed;
    }
  }
}

TEST(Green, AVergeHasPolesInMoreThanHalfOfTheStreets) {
  int with = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    MadeSite made(green(), seed);
    const Strip strip{2, 0, Use::verge};
    build_verge(made.site, made.lot(strip));
    with += made.objects_of("pole") > 0;
  }
  EXPECT_GT(with, 15);
  EXPECT_LT(with, 30);
}

TEST(Green, AGardenHasCarsInItsDrivesWhereOneParks) {
  Population population = green();
  EXPECT_EQ(made_by(build_garden, population).vehicles, 0);
  population.parked = 1;
  population.heavy = 0;
  EXPECT_GT(made_by(build_garden, population).vehicles, 1.5);
}

TEST(Green, ANarrowGardenHasNoDrive) {
  Population population = green();
  population.parked = 1;
  EXPECT_EQ(made_by(build_garden, population, 3).vehicles, 0);
}

TEST(Green, CarsInDrivesStandAcrossTheStreet) {
  Population population = green();
  population.parked = 1;
  population.heavy = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    MadeSite made(population, seed);
    const Strip strip{8, 0, Use::garden};
    build_garden(made.site, made.lot(strip));
    for (const TrueObject& object : made.world.objects) {
      if (object.class_name != "vehicle") continue;
      EXPECT_NEAR(std::cos(core::yaw(cuboid_of(object).pose.linear())), 0, 1e-6);
    }
  }
}

TEST(Green, ABarrierIsAFenceOrAHedgeAlongItsWholeLot) {
  std::set<int> labels;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    MadeSite made(green(), seed);
    const Strip strip{0.6, 0, Use::barrier};
    build_barrier(made.site, made.lot(strip, 1, 10));
    const bool hedge = !made.world.placements.empty();
    const Eigen::AlignedBox3d box = hedge ? box_of_placements(made.world) : box_of(made.mesh());
    EXPECT_LT(box.min().x(), -75) << seed;
    EXPECT_GT(box.max().x(), 75) << seed;
    EXPECT_LT(box.sizes().y(), 1.6) << seed;
    for (const int label : labels_of(made.world, made.mesh())) labels.insert(label);
    if (hedge) labels.insert(kVegetation);
  }
  EXPECT_EQ(labels, (std::set<int>{kFence, kOtherStructure, kVegetation}));
}

}  // namespace
}  // namespace saker::simulation
