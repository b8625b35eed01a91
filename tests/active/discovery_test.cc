#include "saker/active/discovery/discovery.h"

#include <gtest/gtest.h>

#include "made_place.h"

namespace saker::active {
namespace {

using namespace made;
using objects::Cuboid;

TEST(Discovery, MappedVehicleOutsideThePriorBecomesATargetOnceAndIsVisited) {
  PlaceFlight flight(kPark, map_of({kPark[0]}));
  EXPECT_LT(flight.fly(), kLong);
  ASSERT_EQ(flight.active.targets().size(), 2U);  // its neighbour; the others are out of range
  EXPECT_TRUE(flight.target(1).discovered);
  EXPECT_EQ(flight.target(1).object_id, 101);
  EXPECT_EQ(flight.done(), 2);
  for (int i = 0; i < 60; ++i) flight.decide();
  EXPECT_EQ(flight.active.targets().size(), 2U);
}

TEST(Discovery, WaitsUntilItHasSettled) {
  PlaceFlight flight({}, map_of({car(30, 0)}));
  (void)map_given(map_of({car(-10, 5)}), flight, 3);
  EXPECT_EQ(flight.active.targets().size(), 1U);
  (void)map_given(map_of({car(-10, 5)}), flight, 2);
  EXPECT_EQ(flight.active.targets().size(), 2U);
}

TEST(Discovery, WhatMovesIsNeverATarget) {
  PlaceFlight flight({}, map_of({car(30, 0)}));
  for (int i = 0; i < 40; ++i) (void)map_given(map_of({car(-20 + i, 8)}), flight, 1);
  EXPECT_EQ(flight.active.targets().size(), 1U);
}

TEST(Discovery, WhatComesAndGoesIsNeverATarget) {
  PlaceFlight flight({}, map_of({car(30, 0)}));
  for (int i = 0; i < 40; ++i) {
    (void)map_given(i % 3 == 0 ? objects::ObjectMap() : map_of({car(-10, 8)}), flight, 1);
  }
  EXPECT_EQ(flight.active.targets().size(), 1U);
}

TEST(Discovery, OutsideTheFenceOrOfAnotherClassOrNotFiniteIsNoTarget) {
  PlaceFlight flight({}, map_of({car(30, 0)}), two_sided(), box_fence(45, 10));
  objects::ObjectMap map = map_of({car(0, 14), car(5, 5), car(NAN, 5)});
  map.objects[1].class_id = kTrunk;
  (void)map_given(map, flight, 10);
  EXPECT_EQ(flight.active.targets().size(), 1U);
}

TEST(Discovery, SameVehicleMappedTwiceIsOneTarget) {
  PlaceFlight flight({}, map_of({car(20, 0)}));
  (void)map_given(map_of({car(20, 0.2), car(20.4, -0.5)}), flight, 10);
  EXPECT_EQ(flight.active.targets().size(), 1U);
  PlaceFlight without({}, {});
  (void)map_given(map_of({car(20, 0.2), car(20.4, -0.5)}), without, 10);
  EXPECT_EQ(without.active.targets().size(), 1U);
}

TEST(Discovery, HasACeiling) {
  ActiveConfig config = two_sided();
  config.discovery.most = 2;
  PlaceFlight flight({}, map_of({car(30, 0)}), config);
  (void)map_given(map_of(kPark), flight, 20);
  EXPECT_EQ(flight.active.targets().size(), 3U);
  config.discovery.most = 0;
  PlaceFlight none({}, map_of({car(30, 0)}), config);
  (void)map_given(map_of(kPark), none, 20);
  EXPECT_EQ(none.active.targets().size(), 1U);
}

TEST(Discovery, TargetThatIsNotThereIsDismissedBeforeItsSidesAreSeen) {
  PlaceFlight flight({}, map_of({car(25, 0)}));
  EXPECT_LT(flight.fly(), 15);  // sooner than one side is seen for long enough and another flown to
  EXPECT_EQ(flight.target(0).status, TargetStatus::visited);
  EXPECT_NE(flight.target(0).reason.find("no vehicle there"), std::string::npos);
  EXPECT_TRUE(flight.target(0).absent);
}

TEST(Discovery, TargetIsKeptWhileAVehicleNearItHasEndsToBeSeen) {
  PlaceFlight flight({}, map_of({car(25, 0)}));
  objects::ObjectMap map;
  map.incomplete.push_back(vehicle(100, car(27, 3)));
  flight.body = {16, 0, 3};
  (void)map_given(map, flight, 20);
  EXPECT_FALSE(flight.target(0).absent);
  (void)map_given({}, flight, 20);
  EXPECT_TRUE(flight.target(0).absent);
}

/// How many targets there are once one of the prior took a vehicle 3 m off and was closed, and
/// others of which nobody saw how long they are stand `off` m from its prior place.
int targets_beside_a_taken_one(const std::vector<double>& off) {
  PlaceFlight flight({car(28, 0)}, map_of({car(25, 0)}));
  EXPECT_LT(flight.fly(), kLong);
  objects::ObjectMap map = *flight.input.map;
  for (const double y : off)
    map.incomplete.push_back(vehicle(static_cast<int>(200 + 10 * y), car(25, y)));
  (void)map_given(map, flight, 3);
  EXPECT_EQ(flight.active.targets().size(), 1U) << "they have to settle";
  (void)map_given(map, flight, 10);
  EXPECT_EQ(flight.target(0).object_id, 100) << "it holds what it had";
  return static_cast<int>(flight.active.targets().size());
}

TEST(Discovery, OneWithEndsToBeSeenIsATargetWhereItIsNearestToThePlaceOfOneThatTookAnother) {
  EXPECT_EQ(targets_beside_a_taken_one({2}), 2);
  EXPECT_EQ(targets_beside_a_taken_one({4}), 1) << "the other one is nearer";
  EXPECT_EQ(targets_beside_a_taken_one({2, -2.5, 2.5}), 2) << "one of the prior, one vehicle";
}

TEST(Discovery, WithoutAPriorOneWithEndsToBeSeenIsATarget) {
  PlaceFlight flight({}, {});
  objects::ObjectMap map;
  map.incomplete.push_back(vehicle(100, car(20, 5)));
  (void)map_given(map, flight, 6);
  ASSERT_EQ(flight.active.targets().size(), 1U);
  EXPECT_EQ(flight.target(0).incomplete_id, 100);
}

TEST(Discovery, TwoOfThePriorForOneVehicleAreOneTarget) {
  PlaceFlight flight({kPark[0]}, map_of({car(19, 6), car(21, 3.5)}));
  EXPECT_LT(flight.fly(), kLong);
  EXPECT_EQ(flight.done(), 1);
  for (int i = 0; i < 10; ++i) flight.decide();
  const int other = flight.target(0).mapped() ? 1 : 0;
  EXPECT_EQ(flight.target(other).reason,
            "the same as target " + std::to_string(flight.target(1 - other).id));
  EXPECT_EQ(flight.active.targets().size(), 2U);
}

TEST(Discovery, WhereSomethingUnmappedStandsItLooksFromAllSides) {
  PlaceFlight flight({}, map_of({car(25, 0)}));
  auto grid = free_grid(60);
  fill(grid, {24, -2, 0}, {27, 1, 1.5});
  flight.input.grid = shared(grid);
  EXPECT_LT(flight.fly(), kLong);
  EXPECT_EQ(flight.target(0).status, TargetStatus::visited);
  EXPECT_FALSE(flight.target(0).absent);
  EXPECT_EQ(flight.target(0).reason, "");
}

TEST(Discovery, TreeOfThePriorIsNoVehicle) {
  PlaceFlight flight({}, map_of({car(25, 0)}));
  auto grid = free_grid(60);
  fill(grid, {25, 0, 0}, {25.5, 0.5, 4});
  flight.input.grid = shared(grid);
  const objects::Cylinder trunk{{25.2, 0.2, 0}, Eigen::Vector3d::UnitZ(), 0.2, 4};
  objects::ObjectMap map;
  map.objects.push_back(vehicle(5, car(0, 0)));
  map.objects[0].class_id = kTrunk;
  map.objects[0].model = trunk;
  flight.body = {16, 0, 3};
  (void)map_given(map, flight, 8);
  EXPECT_TRUE(flight.target(0).absent);
  EXPECT_EQ(flight.active.targets().size(), 1U);
}

}  // namespace
}  // namespace saker::active
