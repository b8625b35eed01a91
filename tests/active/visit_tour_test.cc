#include <gtest/gtest.h>

#include <numbers>
#include <set>

#include "made_flight.h"
#include "saker/active/tour/target_tour.h"
#include "saker/core/rng.h"

namespace saker::active {
namespace {

using namespace made;
using objects::Cuboid;
using std::numbers::pi;

const objects::ClassTable kTable;
const VisitConfig kVisit;
const GoalsConfig kGoals;

/// With policy `visit`, or with what the configuration says.
struct Flight : made::Flight {
  explicit Flight(const std::vector<Cuboid>& cars, const InGeofence& in_geofence = everywhere,
                  const ActiveConfig& config = two_sided())
      : made::Flight(make_tour(config, kTable, map_of(cars), in_geofence)) {}
};

const std::vector<Cuboid> kStreet = {car(20, 5), car(40, -4, 0.5), car(60, 6, 1.2), car(80, -8, 3)};

TEST(Visit, WithoutTargetsIsFinishedAtOnce) {
  Flight flight({});
  EXPECT_EQ(flight.decide().status, ActiveStatus::finished);
  EXPECT_FALSE(flight.plan.goal);
}

TEST(Visit, ByDefaultLooksAtEachTargetOnce) {
  Flight flight(kStreet, everywhere, visiting());
  flight.map(kStreet);
  EXPECT_LT(flight.fly(400), 400);
  EXPECT_LE(flight.goals.size(), kStreet.size());
  EXPECT_EQ(flight.plan.done, static_cast<int>(kStreet.size()));
}

TEST(Visit, EndsWithEveryTargetDoneWhenAllAreMapped) {
  Flight flight(kStreet);
  flight.map(kStreet);
  EXPECT_LT(flight.fly(300), 300);
  EXPECT_EQ(flight.plan.done, 4);
  EXPECT_EQ(flight.plan.pending, 0);
}

TEST(Visit, EndsWithEveryTargetVisitedWhenNoneIsMapped) {
  Flight flight(kStreet);
  EXPECT_LT(flight.fly(300), 300);
  EXPECT_EQ(flight.plan.visited, 4);
}

TEST(Visit, FliesToOppositeObliqueViewsOfAMappedVehicle) {
  const Cuboid vehicle = car(20, 5, 0.7);
  Flight flight({vehicle});
  flight.map({vehicle});
  flight.fly(300);
  ASSERT_EQ(flight.goals.size(), 2U);
  const double between = flight.goals[0].bearing - flight.goals[1].bearing;
  EXPECT_GE(std::abs(std::remainder(between, 2 * pi)), 119.9 * pi / 180);
  for (const Viewpoint& viewpoint : flight.goals) {
    EXPECT_GT(std::abs(std::sin(2 * (viewpoint.bearing - 0.7))), 0.8);
  }
}

TEST(Visit, AVehicleWhoseEndNobodySawIsLookedAtFromBetweenItsSidesToo) {
  const Cuboid end_hidden = car(20, 5, 0.7);
  for (const bool between : {false, true}) {
    ActiveConfig config = two_sided();
    config.visit_policy.between = between;
    Flight flight({end_hidden}, everywhere, config);
    objects::ObjectMap map;
    map.incomplete = {vehicle(7, end_hidden)};
    flight.input.map = std::make_shared<const objects::ObjectMap>(map);
    EXPECT_LT(flight.fly(300), 300);
    EXPECT_EQ(flight.plan.visited, 1);
    EXPECT_EQ(flight.goals.size() > 2, between) << flight.goals.size();
    EXPECT_LE(flight.goals.size(), 6U);
  }
}

TEST(Visit, AMappedVehicleNeedsNoSidesBetween) {
  ActiveConfig config = two_sided();
  config.visit_policy.between = true;
  Flight flight(kStreet, everywhere, config);
  flight.map(kStreet);
  EXPECT_LT(flight.fly(300), 300);
  EXPECT_EQ(flight.plan.done, 4);
  EXPECT_LE(flight.goals.size(), 8U);
}

TEST(Visit, StaysUntilTheTargetWasInViewForLongEnough) {
  Flight flight({car(20, 0)});
  flight.decide();
  const Viewpoint first = *flight.plan.goal;
  flight.body = first.position;
  for (int second = 0; second < kVisit.dwell_s; ++second) {
    EXPECT_EQ(flight.plan.goal->id, first.id);
    flight.decide();
  }
  EXPECT_NE(flight.plan.goal->id, first.id);
}

TEST(Visit, CountsNoTimeThatItDidNotLookOn) {
  Flight flight({car(20, 0)});
  flight.decide();
  const Viewpoint first = *flight.plan.goal;
  flight.body = first.position;
  flight.input.stamp += 100 * kNanosecondsPerSecond;
  EXPECT_EQ(flight.decide().goal->id, first.id);
}

TEST(Visit, FollowsTheTour) {
  Flight flight(kStreet);
  flight.map(kStreet);
  flight.decide();
  EXPECT_EQ(flight.plan.tour.size(), 4U);
  EXPECT_GT(flight.plan.tour_length_m, 2 * 80);
  EXPECT_EQ(flight.plan.goal->target_id, flight.plan.tour.front());
}

TEST(Visit, KeepsItsGoalsWhileEstimatesTremble) {
  core::Rng rng(3);
  Flight flight(kStreet);
  for (int step = 0; step < 300 && flight.decide().status == ActiveStatus::flying; ++step) {
    std::vector<Cuboid> trembling = kStreet;
    for (Cuboid& cuboid : trembling) {
      cuboid.pose.translation().head<2>() += Eigen::Vector2d(rng.normal(), rng.normal()) * 0.05;
      cuboid.size += Eigen::Vector3d(rng.normal(), rng.normal(), rng.normal()) * 0.05;
    }
    flight.map(trembling);
    const Eigen::Vector3d way = flight.plan.goal->position - flight.body;
    flight.body += way * std::min(1.0, 2 / std::max(way.norm(), 1e-9));
  }
  EXPECT_EQ(flight.plan.done, 4);
  EXPECT_LE(flight.goals.size(), 12U);
}

TEST(Visit, NeighboursSeenAtOnceAreVisitedAtOnce) {
  const std::vector<Cuboid> pair = {car(20, 0, pi / 2), car(22.6, 0, pi / 2)};
  Flight flight(pair);
  flight.map(pair);
  flight.fly(300);
  EXPECT_EQ(flight.plan.done, 2);
  EXPECT_LE(flight.goals.size(), 3U);
}

TEST(Visit, WhatIsWalledInIsUnreachableWithItsReasonAndTheOthersAreDone) {
  auto grid = free_grid(32);
  for (const double side : {-5.0, 4.5}) {  // four walls around the car at (20, 0)
    fill(grid, {20 + side, -5, 0}, {20.5 + side, 5, 7});
    fill(grid, {15, side, 0}, {25, side + 0.5, 7});
  }
  const std::vector<Cuboid> cars = {car(20, 0), car(-15, 10)};
  Flight flight(cars);
  flight.map(cars);
  flight.see(grid);
  EXPECT_LT(flight.fly(300), 300);
  EXPECT_EQ(flight.target(0).status, TargetStatus::unreachable);
  EXPECT_NE(flight.target(0).reason.find("hidden"), std::string::npos) << flight.target(0).reason;
  EXPECT_EQ(flight.target(1).status, TargetStatus::done);
}

TEST(Visit, OneSideIsEnoughWhereThereIsNoOther) {
  const InGeofence street = [](const Eigen::Vector3d& p) { return p.y() < -2; };
  Flight flight({car(20, 5)}, street);
  flight.map({car(20, 5)});
  EXPECT_LT(flight.fly(300), 300);
  EXPECT_EQ(flight.target(0).status, TargetStatus::done);
  EXPECT_NE(flight.target(0).reason.find("1 of 2 sides"), std::string::npos);
}

TEST(Visit, OutsideTheGeofenceNothingIsTried) {
  Flight flight(kStreet, [](const Eigen::Vector3d& p) { return p.x() < 0; });
  EXPECT_EQ(flight.fly(5), 0);
  EXPECT_EQ(flight.plan.unreachable, 4);
  EXPECT_TRUE(flight.goals.empty());
}

TEST(Visit, GoalThatTurnsOutToBeBlockedIsReplaced) {
  Flight flight({car(20, 0)});
  flight.see(free_grid());
  flight.decide();
  const Eigen::Vector3d blocked = flight.plan.goal->position;
  auto grid = free_grid();
  fill(grid, blocked.array() - 1, blocked.array() + 1);
  flight.see(grid);
  ASSERT_TRUE(flight.decide().goal);
  EXPECT_GT((flight.plan.goal->position - blocked).norm(), 1);
  EXPECT_LT(flight.fly(300), 300);
  EXPECT_EQ(flight.plan.visited, 1);
}

TEST(Visit, KnowsThatTheBlockIsInOdom) {
  auto grid = free_grid();
  fill(grid, {-30, -30, 0}, {30, 30, 7});  // solid in odom …
  Flight flight({car(20, 0)});
  flight.see(grid);
  flight.input.T_world_odom = Eigen::Translation3d(500, 0, 0);  // … and far from here in world
  EXPECT_TRUE(flight.decide().goal);
  flight.input.T_world_odom.setIdentity();
  flight.decide();
  EXPECT_EQ(flight.plan.status, ActiveStatus::finished);
}

TEST(Visit, VehicleThatNeverMovesEnds) {
  Flight flight(kStreet);
  flight.speed = 0;
  const double each = kGoals.attempts * kGoals.most_refusals * (kGoals.standing_s + 3);
  EXPECT_LT(flight.fly(1000), 4 * each);
  EXPECT_EQ(flight.plan.unreachable, 4);
  EXPECT_NE(flight.target(2).reason.find("no nearer"), std::string::npos);
}

TEST(Visit, VehicleThatWandersButComesNoNearerEnds) {
  Flight flight(kStreet);
  int decisions = 0;
  for (; decisions < 1000 && flight.decide().goal; ++decisions) {
    flight.body.x() = decisions % 2 ? -1 : 1;
  }
  EXPECT_LT(decisions, 4 * kGoals.attempts * kGoals.most_refusals * (kGoals.patience_s + 3));
  EXPECT_EQ(flight.plan.unreachable, 4);
}

TEST(Visit, DetourIsFlownToItsEndWhileTheVehicleMoves) {
  Flight flight({car(30, 0)});
  flight.decide();
  const int goal = flight.plan.goal->id;
  for (int second = 0; second + 2 < kGoals.patience_s;
       ++second) {  // away from it, around something
    flight.body.y() += 0.5;
    EXPECT_EQ(flight.decide().goal->id, goal);
  }
}

TEST(Visit, MotionThatRefusesEverythingEnds) {
  Flight flight(kStreet);
  int decisions = 0;
  while (decisions < 1000 && flight.decide().goal) {
    flight.tour.refuse(flight.plan.goal->id, "no path");
    ++decisions;
  }
  EXPECT_EQ(decisions, 4 * kGoals.attempts * kGoals.most_refusals);
  EXPECT_EQ(flight.plan.unreachable, 4);
  EXPECT_NE(flight.target(0).reason.find("no path"), std::string::npos);
}

TEST(Visit, BlockThatFlickersEnds) {
  Flight flight({car(20, 0)});
  flight.speed = 0.6;  // makes progress towards each goal, and never arrives
  auto solid = free_grid();
  int decisions = 0;
  for (; decisions < 2000 && flight.decide().goal; ++decisions) {
    auto grid = free_grid();
    const Eigen::Vector3d goal = flight.plan.goal->position;
    fill(grid, goal.array() - 1, goal.array() + 1);
    flight.see(grid);
  }
  EXPECT_LE(decisions, 2 * kGoals.attempts * kGoals.most_goals);
}

TEST(Visit, RefusedViewpointIsNotOfferedAgainNorOneBesideIt) {
  Flight flight({car(20, 0)});
  flight.decide();
  const Viewpoint refused = *flight.plan.goal;
  flight.tour.refuse(refused.id, "no path");
  flight.decide();
  EXPECT_GE((flight.plan.goal->position - refused.position).norm(), kGoals.refused_m);
}

TEST(Visit, RefusalOfAnotherViewpointThanTheGoalChangesNothing) {
  Flight flight({car(20, 0)});
  flight.decide();
  const int goal = flight.plan.goal->id;
  for (int i = 0; i < 10; ++i) flight.tour.refuse(goal + 1, "late news");
  EXPECT_EQ(flight.decide().goal->id, goal);
}

TEST(Visit, TargetThatWasRefusedIsTriedAgainAfterTheOthers) {
  ActiveConfig one_way = two_sided();
  one_way.goals.return_home = false;
  Flight flight({car(15, 0), car(40, 0)}, everywhere, one_way);
  for (int i = 0; i < kGoals.most_refusals; ++i) {
    EXPECT_EQ(flight.decide().goal->target_id, 0);
    flight.tour.refuse(flight.plan.goal->id, "no path");
  }
  EXPECT_EQ(flight.decide().goal->target_id, 1);
  EXPECT_LT(flight.fly(300), 300);
  EXPECT_EQ(flight.plan.visited, 2);
}

TEST(Visit, InputThatIsNotFiniteOrNotNewerChangesNothing) {
  Flight flight({car(20, 0)});
  flight.decide();
  const int goal = flight.plan.goal->id;
  ActiveInput old = flight.input;
  EXPECT_EQ(flight.tour.plan(old, kBudget).status, ActiveStatus::invalid);
  const Eigen::Vector3d body = flight.body;
  flight.body.setConstant(NAN);
  EXPECT_EQ(flight.decide().status, ActiveStatus::invalid);
  flight.body = body;
  EXPECT_EQ(flight.decide().goal->id, goal);
}

TEST(Visit, DecidesTheSameTwice) {
  Flight once(kStreet), twice(kStreet);
  once.map(kStreet);
  twice.map(kStreet);
  once.fly(300);
  twice.fly(300);
  ASSERT_EQ(once.goals.size(), twice.goals.size());
  for (std::size_t i = 0; i < once.goals.size(); ++i) {
    EXPECT_EQ(once.goals[i].position, twice.goals[i].position);
  }
}

TEST(Visit, SaysWhyEachCandidateIsRefused) {
  auto grid = free_grid();
  fill(grid, {20, 8, 0}, {24, 12, 7});
  Flight flight({car(20, 0)}, [](const Eigen::Vector3d& p) { return p.y() > -9; });
  flight.see(grid);
  std::set<Refusal> reasons;
  for (const ViewpointCandidate& candidate : flight.decide().candidates)
    reasons.insert(candidate.refusal);
  EXPECT_TRUE(reasons.contains(Refusal::none));
  EXPECT_TRUE(reasons.contains(Refusal::outside_geofence));
  EXPECT_TRUE(reasons.contains(Refusal::occupied));
}

}  // namespace
}  // namespace saker::active
