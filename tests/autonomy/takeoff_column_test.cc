#include "saker/autonomy/takeoff_column.h"

#include <gtest/gtest.h>

#include "kinematic_flight.h"

namespace saker::autonomy {
namespace {

using occupancy::Cell;
using State = TakeoffColumn::State;

constexpr double kHeight_m = 3;
const Eigen::Vector3d kBody(0, 0, 0.1);

/// All round is known but what a lidar on the ground does not see.
occupancy::OccupancyGrid unseen_above() {
  occupancy::OccupancyGrid grid = free_block(5);
  fill(grid, {-2, -2, 1}, {2, 2, 8}, Cell::unknown);
  return grid;
}

TakeoffColumn look(const occupancy::OccupancyGrid& grid, double stated_height_m,
                   double stated_radius_m = 2.5) {
  motion::ClearanceConfig clearance;
  clearance.takeoff_height_m = stated_height_m;
  clearance.takeoff_radius_m = stated_radius_m;
  return look_up(grid, kBody, kHeight_m, clearance, {.takeoff = Eigen::Vector3d::Zero()});
}

TEST(TakeoffColumn, ThatWasSeenIsFree) { EXPECT_EQ(look(free_block(5), 0).state, State::free); }

TEST(TakeoffColumn, ThatWasNotSeenIsFreeOnlyWhereItIsStated) {
  EXPECT_EQ(look(unseen_above(), 8).state, State::free);
  const TakeoffColumn low = look(unseen_above(), 2);
  EXPECT_EQ(low.state, State::unknown);
  EXPECT_NEAR(low.above_m, 2, 0.26);
  EXPECT_EQ(look(unseen_above(), 8, 0.3).state, State::unknown) << "narrower than the vehicle";
}

TEST(TakeoffColumn, WithABranchInItIsNotFreeWhateverIsStated) {
  occupancy::OccupancyGrid grid = unseen_above();
  fill(grid, {0.25, 0, 2}, {0.5, 0.25, 2.25}, Cell::occupied);
  const TakeoffColumn column = look(grid, 8);
  EXPECT_EQ(column.state, State::occupied);
  EXPECT_NEAR(column.above_m, 2, 0.3);
  EXPECT_TRUE(column.blocked());
}

TEST(TakeoffColumn, WhatStandsBesideOrIsHigherDoesNotMatter) {
  occupancy::OccupancyGrid grid = unseen_above();
  fill(grid, {1, -5, 0}, {1.5, 5, 8}, Cell::occupied);
  fill(grid, {-5, -5, 5}, {5, 5, 8}, Cell::occupied);
  EXPECT_EQ(look(grid, 8).state, State::free);
}

TEST(TakeoffColumn, OfAPlaceThatIsNotANumberWasNotLookedAt) {
  const Eigen::Vector3d nowhere = Eigen::Vector3d::Constant(NAN);
  EXPECT_EQ(look_up(free_block(5), nowhere, 3, {}, {}).state, State::not_looked);
}

}  // namespace
}  // namespace saker::autonomy
