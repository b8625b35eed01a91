#include "ordered_mission.h"

// What a mission makes of the ground that planning sees below it.
namespace saker::autonomy {
namespace {

constexpr MissionOrders kMoves = {GuidanceOrder::follow, PlanningOrder::land};
constexpr MissionOrders kStops = {GuidanceOrder::hold, PlanningOrder::land};

TEST_F(InFlight, OverFitGroundItLandsAtOnce) {
  come_home();
  ASSERT_TRUE(run_to(MissionPhase::landing, 0.1));
  EXPECT_EQ(sent(CommandKind::land), 1);
}

TEST_F(InFlight, OverAVehicleItHoversSaysSoAndLandsWhenItHasGone) {
  ground = Ground::occupied;
  value = 1.4;
  come_home();
  ASSERT_TRUE(run_to(MissionPhase::landing, 0.1));
  EXPECT_NE(events.back().text.find("something 1.4 m high stands there"), std::string::npos)
      << events.back().text;
  run(5);
  EXPECT_EQ(orders, kMoves);
  EXPECT_EQ(sent(CommandKind::land), 0);
  ground = Ground::fit;
  run(0.1);
  EXPECT_EQ(sent(CommandKind::land), 1);
  ASSERT_TRUE(run_to(MissionPhase::done));
  EXPECT_TRUE(supervisor.mission().succeeded());
}

TEST_F(InFlight, WithoutAFitPlaceItLandsAfterAWhileWithItsCause) {
  ground = Ground::no_ground;
  come_home();
  ASSERT_TRUE(run_to(MissionPhase::landing, 0.1));
  run(config.place_s - 0.2);
  EXPECT_EQ(sent(CommandKind::land), 0);
  run(0.4);
  EXPECT_EQ(sent(CommandKind::land), 1);
  EXPECT_EQ(outcome(), Cause::place_unfit);
}

TEST_F(InFlight, OrderedToLandWhileItMovesItStopsFirstAndLooks) {
  speed = 2;
  EXPECT_EQ(order(OrderKind::land).state, OrderState::accepted);
  EXPECT_EQ(orders, kStops);
  run(1);
  EXPECT_EQ(sent(CommandKind::land), 0);
  speed = 0;
  run(0.1);
  EXPECT_EQ(sent(CommandKind::land), 1);
}

TEST_F(Orders, OrderedToLandInTheClimbItDoesNotClimbOn) {
  ASSERT_TRUE(run_to(MissionPhase::takeoff));
  speed = 1;
  ground = Ground::unseen;
  EXPECT_EQ(order(OrderKind::land).state, OrderState::accepted);
  EXPECT_EQ(sent(CommandKind::land), 1);
  EXPECT_EQ(mode, VehicleMode::land);
}

TEST_F(InFlight, AnAbortDoesNotLook) {
  ground = Ground::occupied;
  order(OrderKind::abort);
  EXPECT_EQ(sent(CommandKind::land), 1);
}

TEST_F(InFlight, AnAbortEndsTheLook) {
  ground = Ground::occupied;
  order(OrderKind::land);
  run(1);
  EXPECT_EQ(sent(CommandKind::land), 0);
  order(OrderKind::abort);
  EXPECT_EQ(sent(CommandKind::land), 1);
}

TEST_F(InFlight, TheLadderEndsTheLook) {
  ground = Ground::steep;
  order(OrderKind::land);
  run(1);
  checker_lives = false;
  checker_died = now;
  run(SafetyConfig{}.verdict_s + 0.1);
  EXPECT_EQ(sent(CommandKind::land), 1);
  EXPECT_EQ(orders, kSilent);
}

TEST_F(InFlight, AnEmptyBatteryDoesNotLook) {
  ground = Ground::occupied;
  battery = 0.1;
  run(0.1);
  EXPECT_EQ(phase(), MissionPhase::landing);
  EXPECT_EQ(sent(CommandKind::land), 1);
}

TEST_F(InFlight, APilotWhoTakesOverWhileItLooksIsNotToldToLand) {
  ground = Ground::occupied;
  order(OrderKind::land);
  run(1);
  take_over();
  run(config.place_s + 5);
  EXPECT_EQ(sent(CommandKind::land), 0);
  EXPECT_TRUE(supervisor.mission().taken_over());
}

}  // namespace
}  // namespace saker::autonomy
