#include "saker/active/discovery.h"

#include <gtest/gtest.h>

#include <sstream>

#include "made_fence.h"
#include "made_flight.h"
#include "made_street.h"
#include "saker/core/error.h"
#include "saker/core/rng.h"

namespace saker::active {
namespace {

using namespace made;
using objects::Cuboid;

const objects::ClassTable kTable;
const core::Budget kBudget = core::Budget::iterations(1000);
constexpr int kLong = 2000;  // decisions, in which every flight must have ended

/// A place with cars, some of which the prior map knows. One that is in range for three seconds
/// gets mapped; the occupancy block knows all.
struct Flight {
  Flight(const std::vector<Cuboid>& there, const objects::ObjectMap& prior,
         ActiveConfig config = two_sided(), const motion::Geofence& fence = box_fence(50, 40))
      : cars(there),
        seen_s(there.size(), 0),
        policy(config, kTable,
               make_policy(config, kTable, prior,
                           [fence](const Eigen::Vector3d& p) { return fence.contains(p); }),
               fence) {
    input.grid = block_of(there);
  }

  void look() {
    objects::ObjectMap map;
    for (std::size_t i = 0; i < cars.size(); ++i) {
      const double away = (cars[i].pose.translation() - body).head<2>().norm();
      if (away < 15) seen_s[i] += 1;
      if (seen_s[i] >= 3) map.objects.push_back(vehicle(100 + static_cast<int>(i), cars[i]));
    }
    input.map = std::make_shared<const objects::ObjectMap>(std::move(map));
  }

  const ActivePlan& decide() {
    input.stamp += kNanosecondsPerSecond;
    input.T_world_body.translation() = body;
    plan = policy.plan(input, kBudget);
    return plan;
  }

  int fly(int most = kLong) {
    for (int step = 0; step < most; ++step) {
      look();
      if (decide().status == ActiveStatus::finished) return step;
      const Eigen::Vector3d way = plan.goal->position - body;
      body += way * std::min(1.0, speed / std::max(way.norm(), 1e-9));
      stops += plan.goal->target_id < 0;
    }
    return most;
  }

  [[nodiscard]] const Target& target(int index) const {
    return policy.targets()[static_cast<std::size_t>(index)];
  }
  /// Cars that are some target's object, and were looked at.
  [[nodiscard]] int done() const {
    return static_cast<int>(
        std::ranges::count(policy.targets(), TargetStatus::done, &Target::status));
  }

  [[nodiscard]] std::string story() const {
    std::ostringstream text;
    for (const Target& it : policy.targets()) {
      text << ' ' << it.id << ' ' << to_string(it.status) << " (" << it.reason << ')';
    }
    return text.str();
  }

  std::vector<Cuboid> cars;
  std::vector<double> seen_s;
  Discovery policy;
  ActiveInput input;
  ActivePlan plan;
  Eigen::Vector3d body = {0, 0, 3};
  double speed = 2;
  int stops = 0;  ///< decisions that flew to a stop of the sweep
};

const std::vector<Cuboid> kPark = {car(20, 5), car(20, 11), car(-15, -12), car(-30, 20),
                                   car(38, -25)};

objects::ObjectMap map_given(const objects::ObjectMap& map, Flight& flight, int decisions) {
  flight.input.map = std::make_shared<const objects::ObjectMap>(map);
  for (int i = 0; i < decisions; ++i) flight.decide();
  return map;
}

TEST(Discovery, OfARightPriorChangesNothing) {
  Flight flight(kPark, map_of(kPark));
  EXPECT_LT(flight.fly(), kLong);
  EXPECT_EQ(flight.policy.targets().size(), kPark.size());
  EXPECT_EQ(flight.done(), 5);
  EXPECT_EQ(flight.stops, 0);
}

TEST(Discovery, MappedVehicleOutsideThePriorBecomesATargetOnceAndIsVisited) {
  Flight flight(kPark, map_of({kPark[0]}));
  EXPECT_LT(flight.fly(), kLong);
  ASSERT_EQ(flight.policy.targets().size(), 2U);  // its neighbour; the others are out of range
  EXPECT_TRUE(flight.target(1).discovered);
  EXPECT_EQ(flight.target(1).object_id, 101);
  EXPECT_EQ(flight.done(), 2);
  for (int i = 0; i < 60; ++i) flight.decide();
  EXPECT_EQ(flight.policy.targets().size(), 2U);
}

TEST(Discovery, WaitsUntilItHasSettled) {
  Flight flight({}, map_of({car(30, 0)}));
  (void)map_given(map_of({car(-10, 5)}), flight, 3);
  EXPECT_EQ(flight.policy.targets().size(), 1U);
  (void)map_given(map_of({car(-10, 5)}), flight, 2);
  EXPECT_EQ(flight.policy.targets().size(), 2U);
}

TEST(Discovery, WhatMovesIsNeverATarget) {
  Flight flight({}, map_of({car(30, 0)}));
  for (int i = 0; i < 40; ++i) (void)map_given(map_of({car(-20 + i, 8)}), flight, 1);
  EXPECT_EQ(flight.policy.targets().size(), 1U);
}

TEST(Discovery, WhatComesAndGoesIsNeverATarget) {
  Flight flight({}, map_of({car(30, 0)}));
  for (int i = 0; i < 40; ++i) {
    (void)map_given(i % 3 == 0 ? objects::ObjectMap() : map_of({car(-10, 8)}), flight, 1);
  }
  EXPECT_EQ(flight.policy.targets().size(), 1U);
}

TEST(Discovery, OutsideTheFenceOrOfAnotherClassOrNotFiniteIsNoTarget) {
  Flight flight({}, map_of({car(30, 0)}), {}, box_fence(45, 10));
  objects::ObjectMap map = map_of({car(0, 14), car(5, 5), car(NAN, 5)});
  map.objects[1].class_id = kTrunk;
  (void)map_given(map, flight, 10);
  EXPECT_EQ(flight.policy.targets().size(), 1U);
}

TEST(Discovery, SameVehicleMappedTwiceIsOneTarget) {
  Flight flight({}, map_of({car(20, 0)}));
  (void)map_given(map_of({car(20, 0.2), car(20.4, -0.5)}), flight, 10);
  EXPECT_EQ(flight.policy.targets().size(), 1U);
  Flight without({}, {});
  (void)map_given(map_of({car(20, 0.2), car(20.4, -0.5)}), without, 10);
  EXPECT_EQ(without.policy.targets().size(), 1U);
}

TEST(Discovery, HasACeiling) {
  ActiveConfig config = two_sided();
  config.discovery.most = 2;
  Flight flight({}, map_of({car(30, 0)}), config);
  (void)map_given(map_of(kPark), flight, 20);
  EXPECT_EQ(flight.policy.targets().size(), 3U);
  config.discovery.most = 0;
  Flight none({}, map_of({car(30, 0)}), config);
  (void)map_given(map_of(kPark), none, 20);
  EXPECT_EQ(none.policy.targets().size(), 1U);
}

TEST(Discovery, TargetThatIsNotThereIsDismissedBeforeItsSidesAreSeen) {
  Flight flight({}, map_of({car(25, 0)}));
  EXPECT_LT(flight.fly(), 15);  // sooner than one side is seen for long enough and another flown to
  EXPECT_EQ(flight.target(0).status, TargetStatus::visited);
  EXPECT_NE(flight.target(0).reason.find("no vehicle there"), std::string::npos);
  EXPECT_TRUE(flight.target(0).absent);
}

TEST(Discovery, TargetIsKeptWhileAVehicleNearItHasEndsToBeSeen) {
  Flight flight({}, map_of({car(25, 0)}));
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
  Flight flight({car(28, 0)}, map_of({car(25, 0)}));
  EXPECT_LT(flight.fly(), kLong);
  objects::ObjectMap map = *flight.input.map;
  for (const double y : off)
    map.incomplete.push_back(vehicle(static_cast<int>(200 + 10 * y), car(25, y)));
  (void)map_given(map, flight, 3);
  EXPECT_EQ(flight.policy.targets().size(), 1U) << "they have to settle";
  (void)map_given(map, flight, 10);
  EXPECT_EQ(flight.target(0).object_id, 100) << "it holds what it had";
  return static_cast<int>(flight.policy.targets().size());
}

TEST(Discovery, OneWithEndsToBeSeenIsATargetWhereItIsNearestToThePlaceOfOneThatTookAnother) {
  EXPECT_EQ(targets_beside_a_taken_one({2}), 2);
  EXPECT_EQ(targets_beside_a_taken_one({4}), 1) << "the other one is nearer";
  EXPECT_EQ(targets_beside_a_taken_one({2, -2.5, 2.5}), 2) << "one of the prior, one vehicle";
}

TEST(Discovery, WithoutAPriorOneWithEndsToBeSeenIsATarget) {
  Flight flight({}, {});
  objects::ObjectMap map;
  map.incomplete.push_back(vehicle(100, car(20, 5)));
  (void)map_given(map, flight, 6);
  ASSERT_EQ(flight.policy.targets().size(), 1U);
  EXPECT_EQ(flight.target(0).incomplete_id, 100);
}

TEST(Discovery, TwoOfThePriorForOneVehicleAreOneTarget) {
  Flight flight({kPark[0]}, map_of({car(19, 6), car(21, 3.5)}));
  EXPECT_LT(flight.fly(), kLong);
  EXPECT_EQ(flight.done(), 1);
  for (int i = 0; i < 10; ++i) flight.decide();
  const int other = flight.target(0).mapped() ? 1 : 0;
  EXPECT_EQ(flight.target(other).reason,
            "the same as target " + std::to_string(flight.target(1 - other).id));
  EXPECT_EQ(flight.policy.targets().size(), 2U);
}

TEST(Discovery, WhereSomethingUnmappedStandsItLooksFromAllSides) {
  Flight flight({}, map_of({car(25, 0)}));
  auto grid = free_grid(60);
  fill(grid, {24, -2, 0}, {27, 1, 1.5});
  flight.input.grid = shared(grid);
  EXPECT_LT(flight.fly(), kLong);
  EXPECT_EQ(flight.target(0).status, TargetStatus::visited);
  EXPECT_FALSE(flight.target(0).absent);
  EXPECT_EQ(flight.target(0).reason, "");
}

TEST(Discovery, TreeOfThePriorIsNoVehicle) {
  Flight flight({}, map_of({car(25, 0)}));
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
  EXPECT_EQ(flight.policy.targets().size(), 1U);
}

/// Where a prior is farther off than the gate (1.1 % of them), only a sweep would find the vehicle.
TEST(Discovery, EveryVehicleOfAPriorThatIsTwoMetresOffIsMappedWhereItIsInTheGate) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    core::Rng rng(seed);
    std::vector<Cuboid> rough = kPark;
    for (Cuboid& it : rough) {
      Eigen::Vector2d off;
      do off = {rng.normal(0, 2), rng.normal(0, 2)};
      while (off.norm() > TargetsConfig{}.gate_m);
      it.pose.translation().head<2>() += off;
    }
    Flight flight(kPark, map_of(rough));
    EXPECT_LT(flight.fly(), kLong);
    EXPECT_EQ(flight.done(), 5) << "seed " << seed << ":" << flight.story();
  }
}

TEST(Discovery, WithoutAPriorTheSweepFindsEveryVehicleAndEnds) {
  Flight flight(kPark, {});
  EXPECT_FALSE(flight.policy.idle());
  EXPECT_LT(flight.fly(), kLong);
  EXPECT_EQ(flight.done(), 5);
  EXPECT_EQ(flight.policy.targets().size(), 5U);
  EXPECT_GT(flight.plan.seen_share, 0.9);
}

TEST(Discovery, SweepTurnsToATargetAndGoesOnAfterwards) {
  Flight flight(kPark, {});
  std::vector<bool> swept;
  for (int step = 0; step < kLong; ++step) {
    if (flight.fly(1) == 0) break;
    const bool stop = flight.plan.goal->target_id < 0;
    if (swept.empty() || swept.back() != stop) swept.push_back(stop);
  }
  EXPECT_GE(swept.size(), 5U);
  EXPECT_TRUE(swept.front());
}

TEST(Discovery, SweepOfAnEmptyPlaceEndsWithoutTargets) {
  Flight flight({}, {});
  EXPECT_LT(flight.fly(), kLong);
  EXPECT_TRUE(flight.policy.targets().empty());
  EXPECT_GT(flight.plan.seen_share, 0.95);
}

TEST(Discovery, SweepIsDoneNeverOrAlwaysWhenConfigured) {
  ActiveConfig never{.policy = PolicyName::visit};
  never.discovery.sweep.when = SweepWhen::never;
  Flight idle(kPark, {}, never);
  EXPECT_TRUE(idle.policy.idle());
  EXPECT_EQ(idle.fly(), 0);
  ActiveConfig always{.policy = PolicyName::visit};
  always.discovery.sweep.when = SweepWhen::always;
  Flight flight(kPark, map_of({kPark[0]}), always);
  EXPECT_LT(flight.fly(), kLong);
  EXPECT_EQ(flight.done(), 5);
}

TEST(Discovery, MotionThatRefusesEveryStopEndsTheSweep) {
  Flight flight({}, {});
  int refused = 0;
  for (; refused < kLong && flight.decide().goal; ++refused) {
    flight.policy.refuse(flight.plan.goal->id, "no path");
  }
  EXPECT_GT(refused, 10);
  EXPECT_LT(refused, kLong);
}

TEST(Discovery, VehicleThatNeverMovesEndsTheSweep) {
  Flight flight({}, {});
  flight.speed = 0;
  const SweepConfig sweep;
  const Coverage coverage(sweep, {}, box_fence(50, 40));
  const double each = sweep.standing_s + 2;
  EXPECT_LT(flight.fly(), static_cast<double>(coverage.stops().size()) * each);
}

TEST(Discovery, OccupiedStopsAreLeftOut) {
  Flight flight({}, {});
  auto grid = free_grid(60);
  fill(grid, {-60, -60, -1}, {60, 60, 7});
  flight.input.grid = shared(grid);
  EXPECT_EQ(flight.fly(), 0);
}

/// Objects appear and vanish, places are free and are not: everything that opens again and again.
TEST(Discovery, WorldThatFlickersEnds) {
  ActiveConfig config = two_sided();
  config.discovery.sweep.when = SweepWhen::always;
  Flight flight({}, map_of(kPark), config);
  core::Rng rng(4);
  const auto free = shared(free_grid(60));
  int step = 0;
  for (; step < 4 * kLong; ++step) {
    objects::ObjectMap map;
    for (int i = 0; i < 8; ++i) {
      if (rng.chance(0.2)) continue;
      map.objects.push_back(vehicle(static_cast<int>(step / 20 * 100 + i), car(8 * i - 30, 12)));
    }
    flight.input.map = std::make_shared<const objects::ObjectMap>(std::move(map));
    flight.input.grid = rng.chance(0.8) ? free : nullptr;
    if (flight.decide().status == ActiveStatus::finished) break;
    const Eigen::Vector3d way = flight.plan.goal->position - flight.body;
    flight.body += way * std::min(1.0, 2 / std::max(way.norm(), 1e-9));
  }
  EXPECT_LT(step, 4 * kLong);
}

TEST(Discovery, InputThatIsNotFiniteOrNotNewerChangesNothing) {
  Flight flight(kPark, {});
  flight.decide();
  const int goal = flight.plan.goal->id;
  EXPECT_EQ(flight.policy.plan(flight.input, kBudget).status, ActiveStatus::invalid);
  const Eigen::Vector3d body = flight.body;
  flight.body.setConstant(NAN);
  EXPECT_EQ(flight.decide().status, ActiveStatus::invalid);
  flight.body = body;
  EXPECT_EQ(flight.decide().goal->id, goal);
}

TEST(Discovery, KeepsIdsOfStopsApartFromThoseOfViewpoints) {
  Flight flight({}, {});
  EXPECT_LT(flight.decide().goal->id, -1);
  EXPECT_EQ(flight.plan.goal->target_id, -1);
}

TEST(Discovery, DecidesTheSameTwice) {
  Flight once(kPark, {}), twice(kPark, {});
  EXPECT_EQ(once.fly(), twice.fly());
  EXPECT_EQ(once.body, twice.body);
}

}  // namespace
}  // namespace saker::active
