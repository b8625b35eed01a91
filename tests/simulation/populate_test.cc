#include "saker/simulation/world/populate.h"

#include <gtest/gtest.h>

#include "made_site.h"

namespace saker::simulation {
namespace {

constexpr double kHalfTurn = M_PI;

Population parked(double share) {
  Population p;
  p.parked = share;
  p.heavy = 0;
  return p;
}

TEST(Site, APlaceIsTakenOnce) {
  MadeSite made;
  EXPECT_TRUE(made.site.claim(10, 5, 1));
  EXPECT_FALSE(made.site.claim(10, 5, 0.1));
  EXPECT_FALSE(made.site.claim(11.4, 5, 0.5));
  EXPECT_TRUE(made.site.claim(11.6, 5, 0.5));
}

TEST(Site, WhatWasRefusedTakesNothing) {
  MadeSite made;
  ASSERT_TRUE(made.site.claim(0, 0, 1));
  EXPECT_FALSE(made.site.claim(1.5, 0, 1));
  EXPECT_TRUE(made.site.claim(2.1, 0, 1));
}

TEST(Site, NobodyStandsInACrossing) {
  MadeSite made({}, 1, 20);
  EXPECT_FALSE(made.site.claim(20, 10, 0.5));
  EXPECT_FALSE(made.site.claim(24.3, 10, 0.5));
  EXPECT_TRUE(made.site.claim(24.7, 10, 0.5));
}

TEST(Site, ARectangleTakesItsLengthAndNotMuchMoreThanItsWidth) {
  MadeSite made;
  ASSERT_TRUE(made.site.claim(0, 0, 0, 2.4, 1.0));
  EXPECT_FALSE(made.site.claim(2.2, 0, 0.1));
  EXPECT_FALSE(made.site.claim(0, 0.9, 0.15));
  EXPECT_TRUE(made.site.claim(2.7, 0, 0.2));
  EXPECT_TRUE(made.site.claim(0, 1.3, 0.2));
}

TEST(Site, ATurnedRectangleLiesAlongItsYaw) {
  MadeSite made;
  ASSERT_TRUE(made.site.claim(0, 0, kHalfTurn / 2, 2.4, 1.0));
  EXPECT_FALSE(made.site.claim(0, 2.2, 0.1));
  EXPECT_TRUE(made.site.claim(2.2, 0, 0.1));
}

TEST(Site, NoRandomRectanglesOverlap) {
  MadeSite made;
  std::vector<objects::Cuboid> taken;
  for (int i = 0; i < 400; ++i) {
    const double s = made.rng.uniform(-30, 30), d = made.rng.uniform(2, 30);
    const double yaw = made.rng.uniform(-3, 3);
    if (!made.site.claim(s, d, yaw, 2.3, 0.9)) continue;
    objects::Cuboid cuboid;
    cuboid.pose = placed(s, d, 0, yaw);
    cuboid.size = {3.6, 1.3, 1};  // the discs leave the corners free
    for (const objects::Cuboid& other : taken) EXPECT_FALSE(overlap(cuboid, other));
    taken.push_back(cuboid);
  }
  EXPECT_GT(taken.size(), 40U);
}

TEST(Site, WithEveryKindAHandOfFiveHoldsAllKindsOfCars) {
  Population population = parked(1);
  population.every_kind = true;
  MadeSite made(population);
  for (int hand = 0; hand < 20; ++hand) {
    std::set<VehicleKind> kinds;
    for (int i = 0; i < 5; ++i) kinds.insert(made.site.next_kind());
    EXPECT_EQ(kinds.size(), 5U);
  }
}

TEST(Site, HatchbacksAreTheMostAndPickupsTheFewest) {
  MadeSite made(parked(1));
  std::map<VehicleKind, int> count;
  for (int i = 0; i < 1200; ++i) ++count[made.site.next_kind()];
  EXPECT_EQ(count[VehicleKind::hatchback], 400);
  EXPECT_EQ(count[VehicleKind::sedan], 300);
  EXPECT_EQ(count[VehicleKind::pickup], 100);
}

TEST(Site, HeavyVehiclesHaveTheirShare) {
  Population population;
  population.heavy = 0.2;
  MadeSite made(population);
  int heavy = 0;
  for (int i = 0; i < 4000; ++i) heavy += made.site.next_kind() >= VehicleKind::truck;
  EXPECT_NEAR(heavy / 4000.0, 0.2, 0.02);
}

TEST(Lot, SharesRunOutwardsFromItsInnerEdge) {
  const MadeSite made;
  const Strip strip{4, 0, Use::lawn};
  EXPECT_DOUBLE_EQ(made.lot(strip, 1, 3).at(0), 3);
  EXPECT_DOUBLE_EQ(made.lot(strip, 1, 3).at(1), 7);
  EXPECT_DOUBLE_EQ(made.lot(strip, -1, 3).at(0.5), -5);
}

TEST(ParallelParking, FullItLeavesNoGapForACar) {
  MadeSite made(parked(1));
  const Strip strip{2.3, 0, Use::parallel_parking};
  build_parallel_parking(made.site, made.lot(strip));
  std::vector<double> along;
  for (const TrueObject& object : made.world.objects)
    along.push_back(cuboid_of(object).pose.translation().x());
  ASSERT_GT(along.size(), 24U);
  std::sort(along.begin(), along.end());
  for (std::size_t i = 1; i < along.size(); ++i) EXPECT_LT(along[i] - along[i - 1], 8.5);
}

TEST(ParallelParking, VehiclesStandOnTheStripAlongTheStreet) {
  MadeSite made(parked(1));
  const Strip strip{2.3, 0, Use::parallel_parking};
  build_parallel_parking(made.site, made.lot(strip, -1));
  for (const TrueObject& object : made.world.objects) {
    const objects::Cuboid& cuboid = cuboid_of(object);
    EXPECT_NEAR(cuboid.pose.translation().y(), -4.15, 0.4);
    EXPECT_NEAR(std::sin(core::yaw(cuboid.pose.linear())), 0, 0.12);
    EXPECT_FALSE(object.moving);
  }
}

TEST(ParallelParking, MostLookWithTheTraffic) {
  for (const double side : {-1.0, 1.0}) {
    double with = 0, all = 0;
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
      MadeSite made(parked(1), seed);
      const Strip strip{2.3, 0, Use::parallel_parking};
      build_parallel_parking(made.site, made.lot(strip, side));
      for (const TrueObject& object : made.world.objects) {
        ++all;
        with += std::cos(core::yaw(cuboid_of(object).pose.linear())) * -side > 0;
      }
    }
    EXPECT_GT(with / all, 0.7) << side;
  }
}

TEST(Parking, TakenIsTheShareThatWasAskedFor) {
  for (const double share : {0.0, 0.4, 1.0}) {
    double vehicles = 0, full = 0;
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
      const Strip strip{5, 0, Use::perpendicular_parking};
      MadeSite made(parked(share), seed), all(parked(1), seed);
      build_perpendicular_parking(made.site, made.lot(strip));
      build_perpendicular_parking(all.site, all.lot(strip));
      vehicles += made.objects_of("vehicle");
      full += all.objects_of("vehicle");
    }
    EXPECT_NEAR(vehicles / full, share, 0.08);
  }
}

TEST(PerpendicularParking, VehiclesStandAcrossTheStreet) {
  int skewed = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    MadeSite made(parked(1), seed);
    const Strip strip{5, 0, Use::perpendicular_parking};
    build_perpendicular_parking(made.site, made.lot(strip));
    double most = 0;
    for (const TrueObject& object : made.world.objects)
      most = std::max(most, std::abs(std::cos(core::yaw(cuboid_of(object).pose.linear()))));
    EXPECT_LT(most, 0.62) << seed;
    skewed += most > 0.15;
  }
  EXPECT_LT(skewed, 6) << "a quarter of the rows are at an angle";
}

TEST(Parking, NoTwoVehiclesStandInEachOther) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    MadeSite made(parked(1), seed);
    const Strip along{2.3, 0, Use::parallel_parking}, across{5, 0, Use::perpendicular_parking};
    build_parallel_parking(made.site, made.lot(along, 1, 3));
    build_perpendicular_parking(made.site, made.lot(across, 1, 6));
    EXPECT_EQ(overlaps(made.world), 0) << seed;
  }
}

TEST(Lane, TrafficMovesAndKeepsToTheRight) {
  Population population = parked(0);
  population.traffic = 0.9;
  for (const double side : {-1.0, 1.0}) {
    MadeSite made(population);
    const Strip strip{3.2, 0, Use::lane};
    build_lane(made.site, made.lot(strip, side, 0));
    ASSERT_GT(made.world.objects.size(), 6U);
    for (const TrueObject& object : made.world.objects) {
      EXPECT_TRUE(object.moving);
      EXPECT_GT(std::cos(core::yaw(cuboid_of(object).pose.linear())) * -side, 0.9);
      EXPECT_NEAR(cuboid_of(object).pose.translation().y(), side * 1.6, 0.7);
    }
  }
}

TEST(Lane, WithoutTrafficItIsEmpty) {
  Population population = parked(1);
  population.traffic = 0;
  MadeSite made(population);
  const Strip strip{3.2, 0, Use::lane};
  build_lane(made.site, made.lot(strip));
  EXPECT_TRUE(made.world.objects.empty());
}

TEST(Populate, EverythingInTheMapStandsOnTheGround) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    MadeSite made(parked(0.8), seed);
    const Strip strips[] = {{2.3, 0, Use::parallel_parking},
                            {3, 0, Use::sidewalk},
                            {6, 0, Use::garden},
                            {20, 0, Use::lawn}};
    double d = 3;
    for (const Strip& strip : strips) {
      const Lot lot = made.lot(strip, 1, d);
      if (strip.use == Use::parallel_parking) build_parallel_parking(made.site, lot);
      if (strip.use == Use::sidewalk) build_sidewalk(made.site, lot);
      if (strip.use == Use::garden) build_garden(made.site, lot);
      if (strip.use == Use::lawn) build_lawn(made.site, lot);
      d += strip.width;
    }
    for (const TrueObject& object : made.world.objects) {
      if (object.class_name == "vehicle") {
        const objects::Cuboid& c = cuboid_of(object);
        EXPECT_NEAR(c.pose.translation().z() - c.size.z() / 2, 0, 1e-6);
      } else {
        EXPECT_NEAR(std::get<objects::Cylinder>(object.model).root.z(), 0, 1e-6);
      }
    }
  }
}

TEST(RandomPopulation, StaysWithinWhatStreetsHold) {
  core::Rng rng(2);
  for (int i = 0; i < 500; ++i) {
    const Population p = random_population(rng);
    for (const double share : {p.parked, p.traffic, p.heavy}) {
      EXPECT_GE(share, 0);
      EXPECT_LE(share, 1);
    }
    EXPECT_GE(p.lamp_spacing, 12);
    EXPECT_GE(p.tree_spacing, 5);
    EXPECT_EQ(p.fleet, FleetTheme::none);
  }
}

}  // namespace
}  // namespace saker::simulation
