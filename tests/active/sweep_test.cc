#include "saker/active/discovery/sweep.h"

#include <gtest/gtest.h>

#include <vector>

#include "made_place.h"

namespace saker::active {
namespace {

using namespace made;
using objects::Cuboid;

TEST(Sweep, WithoutAPriorTheSweepFindsEveryVehicleAndEnds) {
  PlaceFlight flight(kPark, {});
  EXPECT_FALSE(flight.active.idle());
  EXPECT_LT(flight.fly(), kLong);
  EXPECT_EQ(flight.done(), 5);
  EXPECT_EQ(flight.active.targets().size(), 5U);
  EXPECT_GT(flight.plan.seen_share, 0.9);
}

TEST(Sweep, SweepTurnsToATargetAndGoesOnAfterwards) {
  PlaceFlight flight(kPark, {});
  std::vector<bool> swept;
  for (int step = 0; step < kLong; ++step) {
    if (flight.fly(1) == 0) break;
    const bool stop = flight.plan.goal->target_id < 0;
    if (swept.empty() || swept.back() != stop) swept.push_back(stop);
  }
  EXPECT_GE(swept.size(), 5U);
  EXPECT_TRUE(swept.front());
}

TEST(Sweep, SweepOfAnEmptyPlaceEndsWithoutTargets) {
  PlaceFlight flight({}, {});
  EXPECT_LT(flight.fly(), kLong);
  EXPECT_TRUE(flight.active.targets().empty());
  EXPECT_GT(flight.plan.seen_share, 0.95);
}

TEST(Sweep, SweepIsDoneNeverOrAlwaysWhenConfigured) {
  ActiveConfig never = visiting();
  never.discovery.sweep.when = SweepWhen::never;
  PlaceFlight idle(kPark, {}, never);
  EXPECT_TRUE(idle.active.idle());
  EXPECT_EQ(idle.fly(), 0);
  ActiveConfig always = visiting();
  always.discovery.sweep.when = SweepWhen::always;
  PlaceFlight flight(kPark, map_of({kPark[0]}), always);
  EXPECT_LT(flight.fly(), kLong);
  EXPECT_EQ(flight.done(), 5);
}

TEST(Sweep, MotionThatRefusesEveryStopEndsTheSweep) {
  PlaceFlight flight({}, {});
  int refused = 0;
  for (; refused < kLong && flight.decide().goal; ++refused) {
    flight.active.refuse(flight.plan.goal->id, "no path");
  }
  EXPECT_GT(refused, 10);
  EXPECT_LT(refused, kLong);
}

TEST(Sweep, VehicleThatNeverMovesEndsTheSweep) {
  PlaceFlight flight({}, {});
  flight.speed = 0;
  const SweepConfig sweep;
  const Coverage coverage(sweep, {}, box_fence(50, 40));
  const double each = sweep.standing_s + 2;
  EXPECT_LT(flight.fly(), static_cast<double>(coverage.stops().size()) * each);
}

TEST(Sweep, OccupiedStopsAreLeftOut) {
  PlaceFlight flight({}, {});
  auto grid = free_grid(60);
  fill(grid, {-60, -60, -1}, {60, 60, 7});
  flight.input.grid = shared(grid);
  EXPECT_EQ(flight.fly(), 0);
}

TEST(Sweep, KeepsIdsOfStopsApartFromThoseOfViewpoints) {
  PlaceFlight flight({}, {});
  EXPECT_LT(flight.decide().goal->id, -1);
  EXPECT_EQ(flight.plan.goal->target_id, -1);
}

}  // namespace
}  // namespace saker::active
