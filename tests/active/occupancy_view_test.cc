#include "saker/active/views/occupancy_view.h"

#include <gtest/gtest.h>

#include <cmath>

#include "made_street.h"

namespace saker::active {
namespace {

using namespace made;

TEST(OccupancyView, IsUnknownWithoutABlock) {
  const OccupancyView nothing;
  EXPECT_EQ(nothing.at({0, 0, 0}), occupancy::Cell::unknown);
  EXPECT_FALSE(nothing.blocked({0, 0, 0}, 5));
  EXPECT_EQ(visible_share({9, 0, 3}, car(0, 0), nothing, 0.5), 1);
}

TEST(OccupancyView, BlocksWithinTheClearanceOnly) {
  auto grid = free_grid();
  fill(grid, {10, -5, 0}, {10.5, 5, 6});  // centres at x = 10.25
  const OccupancyView block{&grid, SE3::Identity()};
  EXPECT_TRUE(block.blocked({9.5, 0.25, 3.25}, 0.9));
  EXPECT_FALSE(block.blocked({9.2, 0.25, 3.25}, 0.9));
  EXPECT_FALSE(block.blocked({100, 0, 3}, 0.9)) << "outside the block";
}

TEST(OccupancyView, MovesWithTheCorrectionBetweenWorldAndOdom) {
  auto grid = free_grid();
  fill(grid, {10, -5, 0}, {10.5, 5, 6});
  const SE3 T_odom_world(Eigen::Translation3d(5, 0, 0));
  const OccupancyView block{&grid, T_odom_world};
  EXPECT_TRUE(block.blocked({5.2, 0, 3}, 0.9));
  EXPECT_FALSE(block.blocked({10.2, 0, 3}, 0.9));
  EXPECT_EQ(block.at({5.2, 0, 3}), occupancy::Cell::occupied);
}

TEST(Visibility, OfATargetInTheOpenIsCompleteThoughItsOwnCellsAreOccupied) {
  auto grid = free_grid();
  fill(grid, {-2.2, -0.9, 0}, {2.2, 0.9, 1.5});
  fill(grid, {-30, -30, -1}, {30, 30, 0});  // the ground
  const OccupancyView block{&grid, SE3::Identity()};
  for (double bearing = 0; bearing < 6; bearing += 0.5) {
    const Eigen::Vector3d eye(9 * std::cos(bearing), 9 * std::sin(bearing), 3);
    EXPECT_EQ(visible_share(eye, car(0, 0), block, 0.5), 1) << bearing;
  }
}

TEST(Visibility, EndsBehindAWall) {
  auto grid = free_grid();
  fill(grid, {4, -10, 0}, {4.5, 10, 4});
  const OccupancyView block{&grid, SE3::Identity()};
  EXPECT_EQ(visible_share({9, 0, 3}, car(0, 0), block, 0.5), 0);
  EXPECT_EQ(visible_share({-9, 0, 3}, car(0, 0), block, 0.5), 1);
}

TEST(Visibility, IsPartialBehindHalfAWall) {
  auto grid = free_grid();
  fill(grid, {-10, 4, 0}, {0, 4.5, 4});
  const OccupancyView block{&grid, SE3::Identity()};
  const double share = visible_share({0.3, 9, 3}, car(0, 0), block, 0.5);
  EXPECT_GT(share, 0.2);
  EXPECT_LT(share, 0.8);
}

TEST(Visibility, IsNotTakenAwayByWhatWasNeverSeen) {
  auto grid = free_grid();
  fill(grid, {-30, -30, -1}, {30, 30, 7}, occupancy::Cell::unknown);
  EXPECT_EQ(visible_share({9, 0, 3}, car(0, 0), {&grid, SE3::Identity()}, 0.5), 1);
}

}  // namespace
}  // namespace saker::active
