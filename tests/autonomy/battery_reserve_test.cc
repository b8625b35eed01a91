#include "saker/autonomy/battery_reserve.h"

#include <gtest/gtest.h>

#include <cmath>

namespace saker::autonomy {
namespace {

constexpr Time kStep = kNanosecondsPerSecond / 50;

/// A flight whose charge falls by `use` a second.
class BatteryReserveTest : public testing::Test {
 protected:
  void stand() { reserve.update(now += kStep, share, place, false); }

  /// Straight to `to` with this speed.
  void fly(const Eigen::Vector3d& to, double speed = 2) {
    const Eigen::Vector3d from = place;
    const double takes_s = (to - from).norm() / speed;
    const int steps = static_cast<int>(std::ceil(takes_s * 50));
    for (int i = 1; i <= steps; ++i) {
      place = from + (to - from) * i / steps;
      step();
    }
  }
  void hover(double seconds) {
    for (int i = 0; i < seconds * 50; ++i) step();
  }
  void step() {
    share -= use * 0.02;
    now += kStep;
    reserve.update(now, gauge ? share : NAN, place, true);
  }

  BatteryReserveConfig config;
  BatteryReserve reserve{config};
  Time now = 100 * kNanosecondsPerSecond;
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  double share = 0.9, use = 1.0 / 1200;
  bool gauge = true;
};

TEST_F(BatteryReserveTest, BeginsWithItsPriorAndFindsTheFlightsOwnUse) {
  stand();
  EXPECT_DOUBLE_EQ(reserve.use_per_s(), 1 / config.endurance_s);
  use = 1.0 / 600;
  hover(300);
  EXPECT_NEAR(reserve.use_per_s(), use, 0.02 * use);
}

TEST_F(BatteryReserveTest, ALoadThatGrowsIsFoundWithinAMinute) {
  stand();
  hover(300);
  use = 1.0 / 400;
  hover(65);
  EXPECT_NEAR(reserve.use_per_s(), use, 0.02 * use);
}

TEST_F(BatteryReserveTest, TheWayHomeIsTheWayItCame) {
  stand();
  fly({0, 0, 3});
  fly({40, 0, 3});
  fly({40, 30, 3});
  EXPECT_GT(reserve.way_home_m(), 69);  // corners are cut
  EXPECT_LE(reserve.way_home_m(), 73.1);
}

TEST_F(BatteryReserveTest, TheWayHomeIsCutShortWhereTheFlightCameByItself) {
  stand();
  fly({0, 0, 3});
  fly({40, 0, 3});
  fly({40, 30, 3});
  fly({0, 30, 3});
  EXPECT_GT(reserve.way_home_m(), 105);
  fly({0, 1, 3});  // beside the place of take-off
  EXPECT_LT(reserve.way_home_m(), 8);
}

TEST_F(BatteryReserveTest, WhatHomeTakesGrowsWithTheWay) {
  stand();
  fly({0, 0, 3});
  const double near = reserve.home_share();
  fly({100, 0, 3});
  const double seconds = 103 / config.home_speed_mps + 3 / config.landing_speed_mps + 5;
  EXPECT_NEAR(reserve.home_share(), config.margin * reserve.use_per_s() * seconds, 0.01);
  EXPECT_GT(reserve.home_share(), near + 0.08);
}

TEST_F(BatteryReserveTest, AnUnknownChargeIsReckonedFromTheLastOne) {
  stand();
  hover(100);
  gauge = false;
  hover(200);
  EXPECT_NEAR(reserve.unknown_s(), 200, 0.1);
  EXPECT_NEAR(reserve.left(), share, 0.04);
  EXPECT_LE(reserve.left(), share);
  gauge = true;
  step();
  EXPECT_EQ(reserve.unknown_s(), 0);
  EXPECT_DOUBLE_EQ(reserve.left(), share);
}

TEST_F(BatteryReserveTest, AGaugeThatStandsStillIsNotBelieved) {
  use = 0;
  stand();
  hover(600);
  EXPECT_NEAR(reserve.left(), 0.9 - 600 * config.least_use / config.endurance_s, 0.01);
}

TEST_F(BatteryReserveTest, WhatIsNoShareIsUnknown) {
  for (const double wrong : {double{NAN}, double{INFINITY}, -INFINITY, -0.01, 1.01}) {
    BatteryReserve other{config};
    other.update(now, wrong, place, false);
    EXPECT_TRUE(std::isnan(other.left())) << wrong;
    EXPECT_TRUE(std::isinf(other.unknown_s())) << wrong;
  }
}

TEST_F(BatteryReserveTest, APlaceThatIsNotANumberLeavesTheWayAsItWas) {
  stand();
  fly({20, 0, 0});
  const double way = reserve.way_home_m();
  place.setConstant(NAN);
  step();
  EXPECT_DOUBLE_EQ(reserve.way_home_m(), way);
}

TEST_F(BatteryReserveTest, OnTheGroundItForgetsTheFlight) {
  stand();
  fly({20, 0, 3});
  stand();
  EXPECT_EQ(reserve.way_home_m(), 0);
  EXPECT_DOUBLE_EQ(reserve.use_per_s(), 1 / config.endurance_s);
}

}  // namespace
}  // namespace saker::autonomy
