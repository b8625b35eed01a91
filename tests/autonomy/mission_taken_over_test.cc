#include "ordered_mission.h"
#include "saker/core/rng.h"

// What a mission does while somebody else flies, and orders, faults and a pilot at any moment.
namespace saker::autonomy {
namespace {

TEST_F(InFlight, WhoTookOverHasItAndNothingThatMovesIsSentHoweverLong) {
  const std::size_t before = commands.size();
  take_over();
  EXPECT_EQ(phase(), MissionPhase::hold);
  EXPECT_EQ(orders, kSilent);
  EXPECT_TRUE(said(Cause::taken_over));
  checker_lives = false;  // the ladder would land
  checker_died = now;
  height = 80;  // outside the geofence, too
  run(60);
  EXPECT_EQ(orders, kSilent);
  EXPECT_EQ(commands.size(), before);
  EXPECT_EQ(phase(), MissionPhase::hold);
}

// Hazard: Vehicle | a pilot takes over while a command is repeated | it is repeated no more | –
TEST_F(InFlight, ACommandThatWaitsForItsAnswerIsNotRepeatedToWhoTookOver) {
  answers = false;
  order(OrderKind::land);
  run(1);
  EXPECT_GT(sent(CommandKind::land), 2);
  for (const long sent_so_far = sent(CommandKind::land); sent(CommandKind::land) == sent_so_far;)
    run(0.02);
  const std::size_t before = commands.size();
  run(0.18);
  ASSERT_EQ(commands.size(), before);
  take_over();  // in the step of the next one
  run(5);
  EXPECT_EQ(commands.size(), before);
  answers = true;
  order(OrderKind::resume);
  EXPECT_TRUE(run_to(MissionPhase::landing, 1));
}

TEST_F(InFlight, ThatNobodySaysAnyMoreThatSomebodyElseFliesGivesNothingBack) {
  take_over();
  taken_over = false;  // the bridge began anew
  run(5);
  EXPECT_EQ(orders, kSilent);
  EXPECT_EQ(phase(), MissionPhase::hold);
}

TEST_F(InFlight, OnlyAResumeTakesItBackAndGoesOnFromWhereItIs) {
  take_over();
  for (const OrderKind kind :
       {OrderKind::hold, OrderKind::return_home, OrderKind::land, OrderKind::abort}) {
    EXPECT_EQ(order(kind).state, OrderState::refused);
  }
  EXPECT_EQ(order(OrderKind::resume).state, OrderState::waiting);
  run(0.1);
  EXPECT_EQ(reply.state, OrderState::accepted);
  ASSERT_TRUE(run_to(MissionPhase::tour, 1));
  EXPECT_EQ(anchors, 2);
  come_home();
  ASSERT_TRUE(run_to(MissionPhase::done));
  EXPECT_TRUE(supervisor.mission().succeeded());
}

TEST_F(InFlight, AfterAResumeItWaitsUntilSetpointsAreObeyedAndHoldsWhereTheyAreNot) {
  take_over();
  obeys_setpoints = false;
  order(OrderKind::resume);
  run(3);
  EXPECT_EQ(phase(), MissionPhase::hold);
  EXPECT_EQ(orders, kHolds);
  run(8);
  EXPECT_TRUE(said(Cause::command_deadline));
  obeys_setpoints = true;
  run(5);
  EXPECT_EQ(phase(), MissionPhase::hold);
  order(OrderKind::resume);
  EXPECT_TRUE(run_to(MissionPhase::tour, 0.1));
}

TEST_F(InFlight, WhereTheFlightControllerDoesNotAgreeThePilotKeepsIt) {
  take_over();
  gives_back = false;
  order(OrderKind::resume);
  run(0.1);
  EXPECT_EQ(reply.state, OrderState::refused);
  EXPECT_EQ(reply.text, "resume: the pilot took over, mode 5");
  EXPECT_EQ(orders, kSilent);
  EXPECT_TRUE(supervisor.mission().taken_over());
}

TEST_F(InFlight, WhereTheLadderWouldHoldOrLandThePilotKeepsIt) {
  take_over();
  battery = 0.1;
  EXPECT_EQ(order(OrderKind::resume).state, OrderState::refused);
  EXPECT_EQ(reply.text, "battery_empty: battery at 10 %");
  EXPECT_EQ(sent(CommandKind::resume), 0);
}

TEST_F(InFlight, APilotWhoLandsItEndsTheMission) {
  take_over();
  mode = VehicleMode::land;
  ASSERT_TRUE(run_to(MissionPhase::done));
  EXPECT_EQ(outcome(), Cause::taken_over);
}

TEST_F(InFlight, APilotWhoTakesItInALandingGivesItBackIntoTheLanding) {
  order(OrderKind::land);
  run(0.5);
  take_over();
  battery = 0.1;  // which is no reason to keep it from landing
  const long before = sent(CommandKind::land);
  order(OrderKind::resume);
  ASSERT_TRUE(run_to(MissionPhase::landing, 1));
  run(0.1);
  EXPECT_EQ(sent(CommandKind::land), before + 1);
  EXPECT_TRUE(run_to(MissionPhase::done));
}

TEST_F(InFlight, AHoldIsOverWhenAPilotGaveItBack) {
  order(OrderKind::hold);
  take_over();
  order(OrderKind::resume);
  EXPECT_TRUE(run_to(MissionPhase::tour, 1));
}

TEST_F(InFlight, ASignalWhileAPilotFliesLandsWhenItIsGivenBack) {
  take_over();
  land_ordered = true;
  run(5);
  EXPECT_EQ(phase(), MissionPhase::hold);
  EXPECT_EQ(sent(CommandKind::land), 0);
  order(OrderKind::resume);
  EXPECT_TRUE(run_to(MissionPhase::landing, 1));
}

TEST_F(Orders, OnTheGroundAVehicleThatIsSomebodyElsesIsNotArmedUntilResume) {
  taken_over = true;
  run(5);
  EXPECT_TRUE(commands.empty());
  EXPECT_EQ(order(OrderKind::resume).state, OrderState::waiting);
  run(0.1);
  EXPECT_EQ(reply.state, OrderState::accepted);
  EXPECT_TRUE(run_to(MissionPhase::tour));
}

/// Orders, faults and a pilot at any moment, drawn from the seed.
class AtAnyMoment : public Orders, public testing::WithParamInterface<int> {
 protected:
  void draw(core::Rng& rng) {
    const auto once_in = [&](double seconds) { return rng.uniform(0, 1) * seconds < 0.02; };
    if (once_in(4)) {
      given.push_back({++last_id, static_cast<OrderKind>(std::min(4.0, rng.uniform(0, 5)))});
    }
    if (once_in(20)) checker_lives = !checker_lives, checker_died = now;
    if (once_in(30) && armed && !taken_over) taken_over = true, mode = VehicleMode::hold;
    if (once_in(60)) battery = rng.uniform(0.1, 1);
    if (once_in(20)) answers = !answers;
  }
};

TEST_P(AtAnyMoment, WhatIsOrderedNothingIsSentToWhoFliesAndALandingStays) {
  core::Rng rng(static_cast<std::uint64_t>(GetParam()));
  bool landing = false;
  for (int i = 0; i < 120 * 50 && phase() != MissionPhase::done; ++i) {
    draw(rng);
    step();
    if (supervisor.mission().taken_over()) {
      EXPECT_EQ(orders, MissionOrders{});
      continue;
    }
    if (landing && !taken_over) {
      EXPECT_TRUE(phase() == MissionPhase::landing || phase() == MissionPhase::done ||
                  phase() == MissionPhase::hold)
          << to_string(phase());
    }
    landing = phase() == MissionPhase::landing;
  }
  // Whatever was ordered before, and whoever flew: it comes down by an order when all is well.
  checker_lives = answers = true;
  battery = 0.9;
  if (supervisor.mission().taken_over()) height = config.height_m;  // within the geofence
  run(SafetyConfig{}.recover_s + 1);
  if (phase() != MissionPhase::done) order(OrderKind::resume);
  run(1);
  if (phase() != MissionPhase::done) order(OrderKind::abort);
  EXPECT_TRUE(phase() == MissionPhase::done || run_to(MissionPhase::done, 30))
      << to_string(phase()) << " " << reply.text;
  EXPECT_EQ(height, 0);
}

INSTANTIATE_TEST_SUITE_P(Seeds, AtAnyMoment, testing::Range(1, 101));

}  // namespace
}  // namespace saker::autonomy
