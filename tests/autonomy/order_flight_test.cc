#include <gtest/gtest.h>

#include <cmath>

#include "faulty_flight.h"

// Orders in a simulated flight, in lockstep, at the moment at which they hurt most: on the way.
namespace saker::autonomy {
namespace {

constexpr double kSettled_s = 2;
constexpr double kHeld_s = 12;  // longer than the ladder waits before it lands
constexpr double kMission_s = 240;
constexpr double kDown_s = 30;
constexpr double kClimbs_s = 1;  // after the motors start: some metre up

bool landed(const FaultyFlight& flight) {
  return flight.result().phase == MissionPhase::done && !flight.plant.rows.back().state.armed;
}

double height(const FaultyFlight& flight) {
  return flight.plant.rows.back().truth.T_world_body.translation().z();
}

TEST(OrderInFlight, AHoldStopsItWithinTwoSecondsForGoodAndAResumeEndsTheMissionWell) {
  FaultyFlight flight;
  ASSERT_TRUE(flight.fly_fast_into([&] { flight.order(OrderKind::hold); }));
  flight.go_on(kHeld_s);
  EXPECT_EQ(flight.reply().state, OrderState::accepted);
  EXPECT_EQ(flight.result().phase, MissionPhase::hold);
  EXPECT_LE(flight.settled_for_good_after(), kSettled_s);
  std::printf("hold: at rest after %.2f s\n", flight.settled_for_good_after());
  flight.order(OrderKind::resume);
  flight.go_on(kMission_s);
  EXPECT_TRUE(flight.result().succeeded);
  EXPECT_TRUE(landed(flight));
  EXPECT_EQ(flight.collisions(), 0);
}

class AnEnd : public testing::TestWithParam<OrderKind> {};

TEST_P(AnEnd, IsAtRestOrLandingWithinTwoSecondsAndThenOnTheGround) {
  FaultyFlight flight;
  ASSERT_TRUE(flight.fly_fast_into([&] { flight.order(GetParam()); }));
  flight.go_on(kDown_s);
  EXPECT_EQ(flight.reply().state, OrderState::accepted);
  EXPECT_LE(flight.settled_for_good_after(), kSettled_s);
  std::printf("%s: at rest or landing after %.2f s\n", to_string(GetParam()),
              flight.settled_for_good_after());
  EXPECT_TRUE(landed(flight));
  EXPECT_EQ(flight.result().outcome, Cause::ordered);
  EXPECT_EQ(flight.collisions(), 0);
}

INSTANTIATE_TEST_SUITE_P(Orders, AnEnd, testing::Values(OrderKind::land, OrderKind::abort),
                         [](const auto& kind) { return std::string(to_string(kind.param)); });

TEST(OrderInFlight, AReturnLandsAtTheTakeOffPlace) {
  FaultyFlight flight;
  ASSERT_TRUE(flight.fly_fast_into([&] { flight.order(OrderKind::return_home); }));
  flight.go_on(kMission_s);
  ASSERT_TRUE(landed(flight));
  EXPECT_EQ(flight.result().outcome, Cause::ordered);
  const auto& rows = flight.plant.rows;
  const Eigen::Vector3d off =
      rows.back().truth.T_world_body.translation() - rows.front().truth.T_world_body.translation();
  EXPECT_LT(off.head<2>().norm(), 2.5);
  EXPECT_EQ(flight.collisions(), 0);
}

TEST(OrderInFlight, AHoldInTheClimbHoldsAtItsHeight) {
  FaultyFlight flight;
  ASSERT_TRUE(flight.fly_into_moment(kClimbs_s, [&] { flight.order(OrderKind::hold); }));
  flight.go_on(kHeld_s);
  EXPECT_EQ(flight.result().phase, MissionPhase::hold);
  EXPECT_NEAR(height(flight), MissionConfig{}.height_m, 0.6);
  EXPECT_LT(flight.plant.rows.back().speed(), 0.2);
  EXPECT_EQ(flight.collisions(), 0);
}

TEST(OrderInFlight, WhileItLandsOnlyTheGroundIsLeft) {
  FaultyFlight flight;
  ASSERT_TRUE(flight.fly_fast_into([&] { flight.order(OrderKind::land); }));
  flight.go_on(2);
  ASSERT_EQ(flight.result().phase, MissionPhase::landing);
  flight.order(OrderKind::hold);
  flight.go_on(0.1);
  EXPECT_EQ(flight.reply().state, OrderState::refused);
  flight.order(OrderKind::resume);
  flight.go_on(0.1);
  EXPECT_EQ(flight.reply().state, OrderState::refused);
  flight.go_on(kDown_s);
  EXPECT_TRUE(landed(flight));
}

}  // namespace
}  // namespace saker::autonomy
