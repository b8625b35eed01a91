#include "saker/motion/destination.h"

#include <gtest/gtest.h>

#include <set>

#include "made_world.h"

namespace saker::motion {
namespace {

const ClearanceConfig kConfig;
const Geofence kFence{GeofenceConfig{}};
const Eigen::Vector3d kStart(-5, 0, 3);

struct Found {
  std::vector<int> reached;
  Destination to;
};

Found find(const made::World& world, const Eigen::Vector3d& goal,
           const core::Budget& budget = made::ample()) {
  const FreeSpace space(*world.grid(), kConfig, kFence, {.vehicle = kStart});
  Found found{reachable_cells(space, kStart, budget), {}};
  found.to = find_destination(space, found.reached, goal, 1.0, budget);
  return found;
}

made::World block() { return made::World({-10, -10, 0}, {10, 10, 6}); }

TEST(ReachableCells, AreAllFreeAndEachOnce) {
  made::World world = block();
  world.add(made::Box{{0, -10, 0}, {0.5, 4, 6}});
  const FreeSpace space(*world.grid(), kConfig, kFence, {.vehicle = kStart});
  const auto reached = reachable_cells(space, kStart, made::ample());
  EXPECT_EQ(std::set<int>(reached.begin(), reached.end()).size(), reached.size());
  for (const int offset : reached)
    EXPECT_TRUE(space.cell_free({offset % 80, offset % 6400 / 80, offset / 6400}));
}

TEST(ReachableCells, EndAtAWall) {
  made::World open = block(), halved = block();
  halved.add(made::Box{{0, -10, 0}, {0.5, 10, 6}});
  const auto all = find(open, {5, 0, 3}).reached, half = find(halved, {5, 0, 3}).reached;
  for (const int offset : half) EXPECT_LT(-10 + 0.25 * (offset % 80), 0);
  EXPECT_LT(half.size(), 0.55 * static_cast<double>(all.size()));
  EXPECT_GT(half.size(), 0.40 * static_cast<double>(all.size()));
}

TEST(Destination, IsTheGoalWhereItCanBeReached) {
  const Found found = find(block(), {5, 1, 3});
  EXPECT_EQ(found.to.kind, DestinationKind::goal);
  EXPECT_EQ(found.to.point, Eigen::Vector3d(5, 1, 3));
}

TEST(Destination, IsNotOnTheOtherSideOfAWallFromTheGoal) {
  made::World world = block();
  world.add(made::Box{{0, -10, 0}, {0.1, 10, 6}});
  EXPECT_EQ(find(world, {1.2, 0, 3}).to.kind, DestinationKind::enclosed);
}

TEST(Destination, IsTheNearestFreePlaceToAGoalInAnObstacle) {
  made::World world = block();
  world.add(made::Box{{4, -2, 0}, {8, 2, 6}});
  const Found found = find(world, {4.05, 0, 3});
  EXPECT_EQ(found.to.kind, DestinationKind::goal);
  EXPECT_LT((found.to.point - Eigen::Vector3d(4.05, 0, 3)).norm(), 1.0 + 1e-9);
}

TEST(Destination, IsBlockedDeepInAnObstacle) {
  made::World world = block();
  world.add(made::Box{{3, -3, 0}, {8, 3, 6}});
  EXPECT_EQ(find(world, {5.5, 0, 3}).to.kind, DestinationKind::blocked);
}

TEST(Destination, LeadsRoundAWallToWhatIsHiddenBehindIt) {
  made::World world = block();
  world.add(made::Box{{0, -10, 0}, {0.5, 5, 6}}).hide(made::Box{{0.5, -10, 0}, {10, 5, 6}});
  const Found found = find(world, {5, -5, 3});
  EXPECT_EQ(found.to.kind, DestinationKind::on_the_way);
  EXPECT_GT(found.to.point.x(), 0.5) << "past the wall";
  EXPECT_GT(found.to.point.y(), 5) << "by its open end";
}

TEST(Destination, LeadsToTheFaceTowardsAGoalOutside) {
  const Found found = find(block(), {60, 0, 3});
  EXPECT_EQ(found.to.kind, DestinationKind::on_the_way);
  EXPECT_GT(found.to.point.x(), 8.7);
  EXPECT_NEAR(found.to.point.y(), 0, 0.5);
}

TEST(Destination, OfAnEnclosedStartIsNone) {
  made::World world = block();
  world.add(made::Box{{-3, -10, 0}, {-2.5, 10, 6}});
  EXPECT_EQ(find(world, {5, 0, 3}).to.kind, DestinationKind::enclosed);
}

TEST(Destination, IsNoneAfterTheDeadline) {
  const auto past = core::Budget::until(core::Budget::Clock::now(), 1000);
  EXPECT_EQ(find(block(), {5, 0, 3}, past).to.kind, DestinationKind::out_of_time);
}

}  // namespace
}  // namespace saker::motion
