#include "saker/autonomy/landing_place.h"

#include <gtest/gtest.h>

#include "kinematic_flight.h"

namespace saker::autonomy {
namespace {

using occupancy::Cell;

const Eigen::Vector3d kAbove(10, 0, 3);  // away from where it took off

/// Known ground at z = −0.25 and free air over it.
class LandingPlacesTest : public testing::Test {
 protected:
  LandingPlace judge(const Eigen::Vector3d& above = kAbove) const { return places().judge(above); }
  std::optional<LandingPlace> nearest(const Eigen::Vector3d& above = kAbove) const {
    return places().nearest_fit(above);
  }
  /// About a place, from the ground up.
  void stand(const Eigen::Vector3d& at, double half_m, double height_m) {
    const Eigen::Vector3d foot(at.x(), at.y(), -0.25), half(half_m, half_m, 0);
    fill(grid, foot - half, foot + half + Eigen::Vector3d(0, 0, height_m), Cell::occupied);
  }
  /// No returns, and nothing seen through it.
  void flood(const Eigen::Vector3d& at, double half_m) {
    const Eigen::Vector3d half(half_m, half_m, 0), foot(at.x(), at.y(), 0);
    fill(grid, foot - half - Eigen::Vector3d(0, 0, 1), foot + half, Cell::unknown);
  }

  occupancy::OccupancyGrid grid = free_block(20);
  LandingConfig config;
  motion::ClearanceConfig clearance;

 private:
  LandingPlaces places() const { return {config, clearance, grid, Eigen::Vector3d::Zero()}; }
};

TEST_F(LandingPlacesTest, LevelGroundIsFit) { EXPECT_TRUE(judge().fit()); }

TEST_F(LandingPlacesTest, APersonOrAVehicleIsNot) {
  stand(kAbove + Eigen::Vector3d(0.5, 0, 0), 0.25, 1.75);
  EXPECT_EQ(judge().ground, Ground::occupied);
  EXPECT_NEAR(judge().value, 1.75, 0.3);
  grid = free_block(20);
  fill(grid, {8, -1, -0.25}, {12.5, 1, 1.4}, Cell::occupied);
  EXPECT_EQ(judge().ground, Ground::occupied) << "its roof is flat";
}

TEST_F(LandingPlacesTest, TheNearestPlaceBesideAVehicleIsFit) {
  fill(grid, {8, -1, -0.25}, {12.5, 1, 1.4}, Cell::occupied);
  const auto place = nearest();
  ASSERT_TRUE(place);
  EXPECT_GT(std::abs(place->above.y()), 1.5);
  EXPECT_LT((place->above - kAbove).norm(), 2.6);
  EXPECT_DOUBLE_EQ(place->above.z(), kAbove.z());
}

TEST_F(LandingPlacesTest, WaterIsNotAndTheShoreIs) {
  flood(kAbove, 2);
  EXPECT_FALSE(judge().fit());
  const auto place = nearest();
  ASSERT_TRUE(place);
  EXPECT_GT((place->above - kAbove).head<2>().cwiseAbs().maxCoeff(), 1.9);
}

TEST_F(LandingPlacesTest, AHoleIsNoGround) {
  fill(grid, {9, -1, -1}, {11, 1, -0.25}, Cell::free);
  EXPECT_EQ(judge().ground, Ground::no_ground);
}

TEST_F(LandingPlacesTest, ASteepSlopeIsNotAGentleOneIs) {
  for (const auto& [rise, ground] : {std::pair{0.1, Ground::fit}, std::pair{0.5, Ground::steep}}) {
    grid = free_block(20);
    for (double x = -20; x < 20; x += 0.25) {
      const double top = std::clamp(-0.25 + rise * (x - 7), -0.25, 2.5);
      fill(grid, {x, -20, -1}, {x + 0.25, 20, top}, Cell::occupied);
    }
    EXPECT_EQ(judge(kAbove + Eigen::Vector3d(0, 0, 1)).ground, ground) << rise;
  }
}

TEST_F(LandingPlacesTest, GapsBetweenBeamsInTheGroundAreNoWater) {
  for (double x = 5; x < 15; x += 0.75) {
    fill(grid, {x, -5, -1}, {x + 0.3, 5, -0.25}, Cell::unknown);
  }
  EXPECT_TRUE(judge().fit());
}

TEST_F(LandingPlacesTest, LevelGroundOnTheBorderOfTwoLayersOfLargeCellsIsFit) {
  grid.resolution_m = 0.5;
  grid.size = {80, 80, 18};
  grid.cells.assign(static_cast<std::size_t>(grid.size.prod()), Cell::free);
  fill(grid, {-20, -20, -1}, {20, 20, -0.5}, Cell::occupied);
  for (double x = -18; x < 20; x += 4) fill(grid, {x, -20, -1}, {x + 0.5, 20, 0}, Cell::occupied);
  EXPECT_TRUE(judge().fit()) << judge().text();
}

TEST_F(LandingPlacesTest, AirThatWasNotSeenHidesSomebody) {
  fill(grid, kAbove - Eigen::Vector3d(1, 1, 2.5), kAbove + Eigen::Vector3d(1, 1, -1.6),
       Cell::unknown);
  EXPECT_EQ(judge().ground, Ground::unseen);
}

TEST_F(LandingPlacesTest, WhatItStoodOnIsFitThoughItNeverSawIt) {
  const Eigen::Vector3d home(0.3, 0.2, 3);
  fill(grid, {-0.9, -0.9, -1}, {0.9, 0.9, 4}, Cell::unknown);
  EXPECT_TRUE(judge(home).fit());
  stand({0.3, 0, 0}, 0.3, 1.7);  // somebody came
  EXPECT_EQ(judge(home).ground, Ground::occupied);
}

TEST_F(LandingPlacesTest, NothingIsFitWhereNothingWasSeen) {
  fill(grid, {-20, -20, -1}, {20, 20, 8}, Cell::unknown);
  EXPECT_FALSE(judge().fit());
  EXPECT_FALSE(nearest());
  EXPECT_EQ(judge(Eigen::Vector3d::Constant(NAN)).ground, Ground::not_looked);
}

}  // namespace
}  // namespace saker::autonomy
