#include "saker/simulation/world/populate_fleet.h"

#include <gtest/gtest.h>

#include "made_site.h"

namespace saker::simulation {
namespace {

Population fleet_of(FleetTheme theme, double parked = 0.9, double traffic = 0.2) {
  Population p;
  p.fleet = theme;
  p.parked = parked;
  p.traffic = traffic;
  return p;
}

using Builder = void (*)(Site&, const Lot&);

/// What a builder puts onto a strip 5 m wide, on each of ten worlds.
template <class Check>
void for_each_lot(Builder build, const Population& population, Check check, double crossing = 1e9) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(seed);
    MadeSite made(population, seed, crossing);
    const Strip strip{5, 0, Use::none};
    build(made.site, made.lot(strip, -1, 3));
    check(made);
  }
}

TEST(FleetTraffic, MovesOrStandsInTheLaneOfItsDirection) {
  for_each_lot(drive_fleet, fleet_of(FleetTheme::european), [](const MadeSite& made) {
    for (const TrueObject& object : made.world.objects) {
      EXPECT_GT(std::cos(core::yaw(cuboid_of(object).pose.linear())), 0.9);
      EXPECT_NEAR(cuboid_of(object).pose.translation().y(), -5.5, 2.6);
    }
  });
}

TEST(FleetTraffic, IsDenserWhereThereIsMore) {
  double sparse = 0, dense = 0;
  const auto count = [](double& sum) {
    return [&sum](const MadeSite& made) { sum += made.objects_of("vehicle"); };
  };
  for_each_lot(drive_fleet, fleet_of(FleetTheme::european, 0, 0.02), count(sparse));
  for_each_lot(drive_fleet, fleet_of(FleetTheme::european, 0, 0.25), count(dense));
  EXPECT_GT(dense, 1.3 * sparse);
}

TEST(FleetTraffic, BeforeACrossingAQueueEndsAtItsLine) {
  int queues = 0;
  for_each_lot(
      drive_fleet, fleet_of(FleetTheme::european, 0, 0.0),
      [&](const MadeSite& made) {
        for (const TrueObject& object : made.world.objects) {
          const objects::Cuboid& c = cuboid_of(object);
          const double front = c.pose.translation().x() + c.size.x() / 2;
          queues += front > -4.5 - 5 && front < -4;
        }
      },
      0);
  EXPECT_GT(queues, 2);
}

/// A vehicle's place is claimed as a row of discs: corners of long ones may meet.
TEST(FleetParking, NoTwoVehiclesStandInEachOtherButForTheirCorners) {
  constexpr double kCorner = 0.3;  // m
  for (const FleetTheme theme :
       {FleetTheme::european, FleetTheme::american, FleetTheme::bus_road}) {
    for (const Builder build : {park_fleet_along, park_fleet_across, drive_fleet}) {
      for_each_lot(build, fleet_of(theme),
                   [](const MadeSite& made) { EXPECT_EQ(overlaps(made.world, kCorner), 0); });
    }
  }
}

TEST(FleetParking, AlongTheStreetVehiclesStandAlongIt) {
  for_each_lot(park_fleet_along, fleet_of(FleetTheme::european), [](const MadeSite& made) {
    EXPECT_GT(made.objects_of("vehicle"), 10);
    for (const TrueObject& object : made.world.objects) {
      EXPECT_FALSE(object.moving);
      EXPECT_LT(std::abs(std::sin(core::yaw(cuboid_of(object).pose.linear()))), 0.15);
    }
  });
}

TEST(FleetParking, AcrossTheStreetNoCarIsLongerThanItsBay) {
  for_each_lot(park_fleet_across, fleet_of(FleetTheme::european), [](const MadeSite& made) {
    double longest = 0;
    for (const TrueObject& object : made.world.objects)
      longest = std::max(longest, cuboid_of(object).size.x());
    EXPECT_LT(longest, 12.7) << "lorries in yards";
  });
}

TEST(FleetParking, IsEmptyWhereNobodyParks) {
  for (const Builder build : {park_fleet_along, park_fleet_across}) {
    for_each_lot(build, fleet_of(FleetTheme::european, 0),
                 [](const MadeSite& made) { EXPECT_EQ(made.objects_of("vehicle"), 0); });
  }
}

TEST(FleetParking, TwoWheelersStandBetweenTheCars) {
  int with = 0;
  for_each_lot(park_fleet_along, fleet_of(FleetTheme::european), [&](const MadeSite& made) {
    const std::set<int> labels = labels_of(made.world, made.mesh());
    with += labels.contains(kMotorcycle) || labels.contains(kBicycle);
  });
  EXPECT_GT(with, 4);
}

TEST(ParkInDrive, PutsOneCarAcrossTheStreet) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    MadeSite made(fleet_of(FleetTheme::american), seed);
    const Strip strip{8, 0, Use::garden};
    park_in_drive(made.site, made.lot(strip), 12);
    ASSERT_EQ(made.objects_of("vehicle"), 1) << seed;
    const objects::Cuboid& c = cuboid_of(made.world.objects[0]);
    EXPECT_LT(c.size.x(), 6.5);
    EXPECT_NEAR(c.pose.translation().x(), 12, 1e-6);
    EXPECT_NEAR(std::cos(core::yaw(c.pose.linear())), 0, 1e-6);
  }
}

TEST(StreetLife, WalksOnSidewalks) {
  int people = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    MadeSite made(fleet_of(FleetTheme::european), seed);
    const Strip strip{4, 0, Use::sidewalk};
    add_street_life(made.site, made.lot(strip));
    people += labels_of(made.world, made.mesh()).contains(kPerson);
    const Eigen::AlignedBox3d box = box_of_label(made.world, kPerson);
    if (box.isEmpty()) continue;
    EXPECT_GT(box.min().y(), -0.5) << seed;
    EXPECT_LT(box.max().y(), 10.5) << seed;
  }
  EXPECT_GE(people, 5);
}

TEST(StreetLife, ConstructionSitesHaveMachinesOnTheGrass) {
  double busy = 0, quiet = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    for (const FleetTheme theme : {FleetTheme::construction, FleetTheme::european}) {
      MadeSite made(fleet_of(theme), seed);
      const Strip strip{16, 0, Use::lawn};
      add_street_life(made.site, made.lot(strip));
      (theme == FleetTheme::construction ? busy : quiet) += made.objects_of("vehicle");
    }
  }
  EXPECT_GT(busy, 3 * quiet);
}

TEST(StreetLife, ALaneHasNone) {
  MadeSite made(fleet_of(FleetTheme::european));
  const Strip strip{4, 0, Use::lane};
  add_street_life(made.site, made.lot(strip));
  EXPECT_TRUE(made.mesh().triangles.empty());
}

TEST(AnyTheme, StreetsAreMostlyEuropeanOrAmerican) {
  for (const WorldKind kind : {WorldKind::street, WorldKind::country}) {
    core::Rng rng(4);
    std::map<FleetTheme, double> share;
    for (int i = 0; i < 4000; ++i) share[any_theme(kind, rng)] += 1 / 4000.0;
    EXPECT_FALSE(share.contains(FleetTheme::none));
    EXPECT_GT(share[FleetTheme::european] + share[FleetTheme::american], 0.6);
    EXPECT_EQ(share.contains(FleetTheme::bus_road), kind == WorldKind::street);
  }
}

}  // namespace
}  // namespace saker::simulation
