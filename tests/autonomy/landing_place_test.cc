#include "saker/autonomy/landing_place.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kinematic_flight.h"

namespace saker::autonomy {
namespace {

using occupancy::Cell;

const Eigen::Vector3d kNowhere = Eigen::Vector3d::Constant(NAN);
constexpr double kFrom_m = 3;

/// Level ground that was seen, whose surface is at −0.25 m, and what stands on it.
class LandingPlaceTest : public testing::Test {
 protected:
  LandingPlace here() const { return look.at(grid, {0, 0}, kFrom_m, kNowhere); }
  LandingPlace near() const {
    return look.near(grid, {0, 0}, kFrom_m, kNowhere, [](const Eigen::Vector2d&) { return true; });
  }
  void put(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
    fill(grid, low, high, Cell::occupied);
  }
  void unsee(double half_m) {
    fill(grid, {-half_m, -half_m, -1}, {half_m, half_m, 8}, Cell::unknown);
  }

  LandingConfig config;
  LandingLook look{config};
  occupancy::OccupancyGrid grid = free_block(10);
};

TEST_F(LandingPlaceTest, LevelGroundThatWasSeenIsFit) {
  EXPECT_TRUE(here().fit()) << here().text();
  EXPECT_NEAR(here().slope_deg, 0, 0.1);
  EXPECT_EQ(near().at, Eigen::Vector2d(0, 0));
}

TEST_F(LandingPlaceTest, WaterFromWhichNothingCameBackIsNot) {
  unsee(2);
  EXPECT_EQ(here().fault, LandingFault::not_seen);
  EXPECT_GE(near().at.norm(), 2);
  EXPECT_TRUE(near().fit());
}

TEST_F(LandingPlaceTest, APersonIsAnObject) {
  put({0.3, -0.2, -0.25}, {0.7, 0.2, 1.5});
  EXPECT_EQ(here().fault, LandingFault::object) << here().text();
  const LandingPlace other = near();
  EXPECT_TRUE(other.fit());
  EXPECT_GT((other.at - Eigen::Vector2d(0.5, 0)).norm(), config.radius_m);
  EXPECT_LE(other.at.norm(), 2);
}

TEST_F(LandingPlaceTest, TheRoofOfAVehicleIsRaised) {
  put({-2.2, -0.9, -0.25}, {2.2, 0.9, 1.3});
  EXPECT_EQ(here().fault, LandingFault::raised) << here().text();
  EXPECT_GT(near().at.cwiseAbs().y(), 0.9);
  EXPECT_TRUE(near().fit());
}

TEST_F(LandingPlaceTest, TheEdgeOfAVehicleIsAnObject) {
  put({-2.2, 0.2, -0.25}, {2.2, 2, 1.3});
  EXPECT_FALSE(here().fit());
}

TEST_F(LandingPlaceTest, ASlopeIsNotFit) {
  for (double x = -9; x < 9; x += 0.25) {
    const double top = -0.25 + x * std::tan(25.0 / 57.3);
    fill(grid, {x, -10, -1}, {x + 0.25, 10, std::min(top, 2.5)}, Cell::occupied);
  }
  EXPECT_FALSE(look.at(grid, {4, 0}, kFrom_m, kNowhere).fit());
}

TEST_F(LandingPlaceTest, AGentleSlopeIsFit) {
  for (double x = -9; x < 9; x += 0.25) {
    const double top = -0.25 + x * std::tan(6.0 / 57.3);
    fill(grid, {x, -10, -1}, {x + 0.25, 10, top}, Cell::occupied);
  }
  for (double x = 1; x < 6; x += 0.25) {
    const LandingPlace place = look.at(grid, {x, 0}, kFrom_m, kNowhere);
    EXPECT_TRUE(place.fit()) << x << " " << place.text();
  }
}

TEST_F(LandingPlaceTest, WhereItStoodThereIsGround) {
  unsee(0.7);
  EXPECT_FALSE(here().fit());
  EXPECT_TRUE(look.at(grid, {0, 0}, kFrom_m, Eigen::Vector3d(0, 0, -0.25)).fit());
}

TEST_F(LandingPlaceTest, WhatIsAboveTheVehicleDoesNotCount) {
  put({-3, -3, 5}, {3, 3, 5.3});
  EXPECT_TRUE(here().fit());
}

TEST_F(LandingPlaceTest, WhereNothingIsFitTheLeastBadIsTaken) {
  unsee(9);
  put({1.6, -0.3, -0.5}, {2.4, 0.3, -0.2});  // a third of a place
  const LandingPlace other = near();
  EXPECT_FALSE(other.fit());
  EXPECT_LT(other.badness(), here().badness());
  EXPECT_GE(other.at.x(), 1);
}

TEST_F(LandingPlaceTest, StaysWhereItIsAllowed) {
  unsee(1);
  const auto right = [](const Eigen::Vector2d& p) { return p.x() > 0; };
  EXPECT_GT(look.near(grid, {0, 0}, kFrom_m, kNowhere, right).at.x(), 0);
}

TEST_F(LandingPlaceTest, WithoutABlockOrAPlaceNothingIsFit) {
  EXPECT_FALSE(look.at({}, {0, 0}, kFrom_m, kNowhere).fit());
  EXPECT_FALSE(look.at(grid, {NAN, 0}, kFrom_m, kNowhere).fit());
  EXPECT_FALSE(look.at(grid, {0, 0}, NAN, kNowhere).fit());
  EXPECT_FALSE(look.at(grid, {50, 0}, kFrom_m, kNowhere).fit());
}

TEST_F(LandingPlaceTest, LooksUpThroughWhatWasSeenFree) {
  const ColumnLook up = look_up(grid, {0, 0, 0}, 0.65, 3.5);
  EXPECT_FALSE(up.blocked());
  EXPECT_EQ(up.unknown, 0);
  EXPECT_GT(up.free, 100);
}

TEST_F(LandingPlaceTest, LooksUpToWhatHangsThere) {
  put({-0.4, -0.2, 2.1}, {0.4, 0.2, 2.2});
  EXPECT_NEAR(look_up(grid, {0, 0, 0}, 0.65, 3.5).lowest_m, 2.1, 0.3);
}

TEST_F(LandingPlaceTest, WhatLiesBeyondTheBlockWasNotSeen) {
  EXPECT_GT(look_up(grid, {0, 0, 0}, 0.65, 20).unknown_share(), 0.5);
  EXPECT_EQ(look_up({}, {0, 0, 0}, 0.65, 3).unknown_share(), 1);
}

}  // namespace
}  // namespace saker::autonomy
