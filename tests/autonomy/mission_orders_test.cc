#include "ordered_mission.h"

// What orders do to a mission, with a vehicle that obeys at once; the table itself: orders_test.cc;
// while a pilot flies: mission_taken_over_test.cc.
namespace saker::autonomy {
namespace {

TEST_F(InFlight, HoldStaysUntilResumeAsLongAsItIsOrderedAgainAndTheMissionSucceeds) {
  for (double held_s = 0; held_s <= config.tour_s; held_s += kOrderedHold_s) {
    EXPECT_EQ(order(OrderKind::hold).state, OrderState::accepted);
    EXPECT_EQ(phase(), MissionPhase::hold);
    run(kOrderedHold_s - 1);
  }
  // Its deadline waits, too.
  EXPECT_EQ(orders, kHolds);
  EXPECT_EQ(order(OrderKind::resume).state, OrderState::accepted);
  run(0.1);
  EXPECT_EQ(phase(), MissionPhase::tour);
  run(5);
  EXPECT_EQ(phase(), MissionPhase::tour);
  come_home();
  ASSERT_TRUE(run_to(MissionPhase::done));
  EXPECT_TRUE(supervisor.mission().succeeded());
}

// Hazard: Orders and the radio | the link dies after an order to hold | returns after 5 min | –
TEST_F(InFlight, AHoldThatNobodySaysAnythingToReturns) {
  order(OrderKind::hold);
  run(kOrderedHold_s - 1);
  EXPECT_EQ(phase(), MissionPhase::hold);
  ASSERT_TRUE(run_to(MissionPhase::return_home, 2));
  EXPECT_EQ(outcome(), Cause::hold_deadline);
  EXPECT_EQ(order(OrderKind::resume).state, OrderState::accepted);  // the link is back
  EXPECT_EQ(phase(), MissionPhase::tour);
  EXPECT_EQ(outcome(), Cause::landed);
}

TEST_F(InFlight, AHoldOnTheWayHomeThatNobodySaysAnythingToGoesOnHome) {
  come_home();
  planning.status = PlanningStatus::flying;
  order(OrderKind::hold);
  EXPECT_TRUE(run_to(MissionPhase::return_home, kOrderedHold_s + 1));
  EXPECT_EQ(outcome(), Cause::landed);
}

TEST_F(InFlight, TheSameOrderOnceMoreIsTheSameAnswerAndNothingElse) {
  order(OrderKind::hold);
  const OrderReply first = reply;
  order(OrderKind::resume);
  run(1);
  reply = {};
  given.push_back(first.order);  // a copy that was late
  step();
  EXPECT_EQ(reply, first);
  run(1);
  EXPECT_EQ(phase(), MissionPhase::tour);
}

TEST_F(InFlight, WhereTheLadderHoldsAnOrderStaysAndResumeDoesNotUndoIt) {
  order(OrderKind::hold);
  checker_lives = false;
  checker_died = now;
  run(2);
  order(OrderKind::resume);
  run(1);
  EXPECT_EQ(phase(), MissionPhase::hold);
  order(OrderKind::hold);
  checker_lives = true;
  run(SafetyConfig{}.recover_s + 1);
  EXPECT_EQ(phase(), MissionPhase::hold);
  order(OrderKind::resume);
  run(0.1);
  EXPECT_EQ(phase(), MissionPhase::tour);
}

TEST_F(InFlight, AHoldThatTheLadderGivesUpOnLands) {
  order(OrderKind::hold);
  checker_lives = false;
  checker_died = now;
  ASSERT_TRUE(run_to(MissionPhase::landing, SafetyConfig{}.land_after_s + 1));
  EXPECT_EQ(outcome(), Cause::checker_silent);
}

TEST_F(InFlight, ALowBatteryEndsAHoldAndAnEmptyOneLands) {
  order(OrderKind::hold);
  battery = 0.28;
  run(0.1);
  EXPECT_EQ(phase(), MissionPhase::return_home);
  EXPECT_EQ(order(OrderKind::hold).state, OrderState::refused);
  EXPECT_NE(reply.text.find("battery_low"), std::string::npos) << reply.text;
  EXPECT_TRUE(said(Cause::order_refused));
  EXPECT_EQ(phase(), MissionPhase::return_home);
  battery = 0.1;
  run(0.1);
  EXPECT_EQ(phase(), MissionPhase::landing);
}

TEST_F(InFlight, ReturnLeadsHomeAndResumeBackToTheTour) {
  EXPECT_EQ(order(OrderKind::return_home).state, OrderState::accepted);
  EXPECT_EQ(phase(), MissionPhase::return_home);
  EXPECT_EQ(outcome(), Cause::ordered);
  run(1);
  order(OrderKind::resume);
  EXPECT_EQ(phase(), MissionPhase::tour);
  come_home();
  ASSERT_TRUE(run_to(MissionPhase::done));
  EXPECT_TRUE(supervisor.mission().succeeded());
}

TEST_F(InFlight, AReturnByItselfIsNotTurnedBack) {
  come_home();
  planning.status = PlanningStatus::flying;
  EXPECT_EQ(order(OrderKind::resume).state, OrderState::refused);
  EXPECT_EQ(phase(), MissionPhase::return_home);
}

TEST_F(InFlight, AHoldOnTheWayHomeGoesOnHomeAndItsDeadlineWaits) {
  come_home();
  planning.status = PlanningStatus::flying;
  run(1);
  order(OrderKind::hold);
  run(config.return_s + 10);
  order(OrderKind::return_home);
  run(5);
  EXPECT_EQ(phase(), MissionPhase::return_home);
  EXPECT_FALSE(said(Cause::return_deadline));
  planning.status = PlanningStatus::home_reached;
  ASSERT_TRUE(run_to(MissionPhase::done));
  EXPECT_TRUE(supervisor.mission().succeeded());  // it would have come home anyway
}

TEST_F(InFlight, WhereTheLadderHoldsAReturnWaitsForIt) {
  checker_lives = false;
  checker_died = now;
  run(1);
  ASSERT_EQ(phase(), MissionPhase::hold);
  EXPECT_EQ(order(OrderKind::return_home).state, OrderState::accepted);
  EXPECT_EQ(phase(), MissionPhase::hold);
  checker_lives = true;
  ASSERT_TRUE(run_to(MissionPhase::return_home, SafetyConfig{}.recover_s + 1));
}

TEST_F(InFlight, LandLandsFromAHoldAndNothingLeadsUpAgain) {
  order(OrderKind::hold);
  lands_for_good_by(OrderKind::land);
}

TEST_F(InFlight, AbortLandsFromTheTourAndNothingLeadsUpAgain) {
  lands_for_good_by(OrderKind::abort);
}

TEST_F(InFlight, AnAbortWhileItLandsGivesTheCommandAgain) {
  order(OrderKind::land);
  run(0.5);
  const long before = sent(CommandKind::land);
  EXPECT_EQ(order(OrderKind::abort).state, OrderState::accepted);
  run(0.1);
  EXPECT_EQ(sent(CommandKind::land), before + 1);
}

TEST_F(Orders, AHoldInTheClimbActsAtItsEndAndAResumeTakesItBack) {
  ASSERT_TRUE(run_to(MissionPhase::takeoff));
  EXPECT_EQ(order(OrderKind::hold).state, OrderState::accepted);
  EXPECT_EQ(phase(), MissionPhase::takeoff);
  ASSERT_TRUE(run_to(MissionPhase::hold));
  EXPECT_NEAR(height, config.height_m, config.height_tolerance_m);
  EXPECT_EQ(anchors, 1);
  run(20);
  EXPECT_EQ(phase(), MissionPhase::hold);
  order(OrderKind::resume);
  EXPECT_TRUE(run_to(MissionPhase::tour, 0.1));
}

TEST_F(Orders, AResumeInTheClimbTakesTheHoldBack) {
  ASSERT_TRUE(run_to(MissionPhase::takeoff));
  order(OrderKind::hold);
  order(OrderKind::resume);
  EXPECT_TRUE(run_to(MissionPhase::tour));
}

TEST_F(Orders, AReturnInTheClimbLands) {
  ASSERT_TRUE(run_to(MissionPhase::takeoff));
  order(OrderKind::return_home);
  EXPECT_EQ(phase(), MissionPhase::landing);
}

TEST_F(Orders, OnTheGroundAHoldKeepsItThereWithoutADeadlineUntilResume) {
  run(0.5);
  EXPECT_EQ(order(OrderKind::hold).state, OrderState::accepted);
  run(2 * config.preflight_s);
  EXPECT_EQ(phase(), MissionPhase::preflight);
  EXPECT_TRUE(commands.empty());
  order(OrderKind::resume);
  EXPECT_TRUE(run_to(MissionPhase::tour));
}

TEST_F(Orders, BeforeArmingReturnLandAndAbortEndIt) {
  run(0.5);
  EXPECT_EQ(order(OrderKind::abort).state, OrderState::accepted);
  EXPECT_EQ(phase(), MissionPhase::done);
  EXPECT_EQ(outcome(), Cause::ordered);
  EXPECT_TRUE(commands.empty());
}

TEST_F(Orders, WhileItArmsAnAbortTurnsTheMotorsOffBeforeItEnds) {
  answers = false;  // what was said first is lost
  ASSERT_TRUE(run_to(MissionPhase::arming));
  armed = true;
  order(OrderKind::abort);
  run(1);
  EXPECT_GT(sent(CommandKind::disarm), 2);
  EXPECT_EQ(phase(), MissionPhase::preflight);
  answers = true;
  ASSERT_TRUE(run_to(MissionPhase::done, 1));
  EXPECT_FALSE(armed);
  EXPECT_EQ(sent(CommandKind::takeoff), 0);
}

TEST_F(Orders, WhileItArmsAHoldIsAgreedToWhenTheMotorsAreOff) {
  answers = false;
  ASSERT_TRUE(run_to(MissionPhase::arming));
  armed = true;
  EXPECT_EQ(order(OrderKind::hold).state, OrderState::waiting);
  run(1);
  EXPECT_EQ(reply.state, OrderState::waiting);
  EXPECT_TRUE(armed);
  answers = true;
  run(0.5);
  EXPECT_EQ(reply.state, OrderState::accepted);
  EXPECT_EQ(reply.text, "motors off, stays on the ground until resume");
  EXPECT_FALSE(armed);
}

// Hazard: Orders and the radio | an order on the ground, the motors do not go off | refused with
//   the cause; the next order tries again | –
TEST_F(Orders, WhereTheMotorsDoNotGoOffTheOrderIsRefusedAndTheNextOneTriesAgain) {
  answers = false;
  ASSERT_TRUE(run_to(MissionPhase::arming));
  armed = true;
  order(OrderKind::hold);
  run(config.command.deadline_s + 0.1);
  EXPECT_EQ(reply.state, OrderState::refused);
  EXPECT_EQ(reply.text, "disarm: no answer for 3 s");
  EXPECT_EQ(order(OrderKind::hold).state, OrderState::waiting);
  answers = true;
  run(0.5);
  EXPECT_EQ(reply.state, OrderState::accepted);
  EXPECT_FALSE(armed);
}

TEST_F(Orders, WhileTheMotorsMayRunAnAbortWaitsForThem) {
  answers = false;
  ASSERT_TRUE(run_to(MissionPhase::arming));
  order(OrderKind::hold);
  EXPECT_EQ(order(OrderKind::abort).state, OrderState::waiting);
  run(1);
  EXPECT_EQ(phase(), MissionPhase::preflight);
  answers = true;
  ASSERT_TRUE(run_to(MissionPhase::done, 1));
  EXPECT_EQ(reply.state, OrderState::accepted);
}

TEST_F(Orders, WhileItArmsAHoldTurnsTheMotorsOffAndResumeArmsAnew) {
  answers = false;
  ASSERT_TRUE(run_to(MissionPhase::arming));
  armed = true;
  answers = true;
  order(OrderKind::hold);
  run(5);
  EXPECT_FALSE(armed);
  EXPECT_EQ(phase(), MissionPhase::preflight);
  order(OrderKind::resume);
  EXPECT_TRUE(run_to(MissionPhase::tour));
}

TEST_F(Orders, ASignalEndsItAlsoWhileAnOrderKeepsItOnTheGround) {
  run(0.5);
  order(OrderKind::hold);
  land_ordered = true;
  EXPECT_TRUE(run_to(MissionPhase::done, 0.1));
}

}  // namespace
}  // namespace saker::autonomy
