#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>

#include "saker/autonomy/supervisor.h"
#include "saker/core/rng.h"

// What orders do to a mission, with a vehicle that obeys at once; the table itself: orders_test.cc.
namespace saker::autonomy {
namespace {

constexpr Time kStep = kNanosecondsPerSecond / 50;

class Orders : public testing::Test {
 protected:
  void run(double seconds) {
    for (const Time end = now + from_seconds(seconds); now < end; now += kStep) step();
  }
  bool run_to(MissionPhase wanted, double seconds = 40) {
    for (const Time end = now + from_seconds(seconds); now < end; now += kStep) {
      step();
      if (phase() == wanted) return true;
    }
    return false;
  }

  /// Given now; what became of it at the next step.
  OrderReply order(OrderKind kind) {
    given.push_back({++last_id, kind});
    step();
    return reply;
  }

  void step() {
    SupervisorInput input;
    input.now = now;
    const Time checker = checker_lives ? now : checker_died;
    input.heard = {now, now, now, checker, now, now, now};
    input.vehicle.stamp = now;
    input.vehicle.armed = armed;
    input.vehicle.mode = mode;
    input.vehicle.battery_share = battery;
    input.vehicle.faults = taken_over ? kTakenOver : 0U;
    input.odometry.status = VehicleOdometryStatus::ok;
    input.odometry.T_odom_body.translation() = Eigen::Vector3d(0, 0, height);
    input.acks = std::exchange(acks, {});
    input.planning = planning;
    input.has_targets = true;
    input.classified_share = 0.6;
    input.land_ordered = land_ordered;
    input.orders = std::exchange(given, {});
    const Mission::Output output = supervisor.step(std::move(input));
    orders = output.orders;
    anchors += output.anchor;
    if (output.reply) reply = *output.reply;
    for (const MissionEvent& event : output.events) events.push_back(event);
    if (output.command) obey(*output.command);
    fly();
  }

  void obey(const Command& command) {
    commands.push_back(command);
    if (!answers) return;
    const bool accepted = command.kind == CommandKind::resume ? gives_back : !taken_over;
    acks.push_back({now, command.id, accepted, accepted ? "" : "the pilot took over, mode 5"});
    if (!accepted) return;
    if (command.kind == CommandKind::arm) armed = true;
    if (command.kind == CommandKind::disarm) armed = false;
    if (command.kind == CommandKind::takeoff) mode = VehicleMode::takeoff;
    if (command.kind == CommandKind::land) mode = VehicleMode::land;
    if (command.kind == CommandKind::resume) taken_over = false, mode = VehicleMode::hold;
  }

  void fly() {
    if (orders.guidance != GuidanceOrder::silent && !taken_over && obeys_setpoints)
      mode = VehicleMode::guided;
    if (mode == VehicleMode::takeoff) height = std::min(3.0, height + 0.02);
    if (mode == VehicleMode::land) height = std::max(0.0, height - 0.02);
    if (mode == VehicleMode::land && height == 0) armed = false;
  }

  /// A pilot has it.
  void take_over() {
    taken_over = true;
    mode = VehicleMode::hold;
    run(0.1);
  }

  [[nodiscard]] MissionPhase phase() const { return supervisor.mission().phase(); }
  [[nodiscard]] Cause outcome() const { return supervisor.mission().outcome(); }
  [[nodiscard]] bool said(Cause cause) const {
    return std::any_of(events.begin(), events.end(),
                       [cause](const MissionEvent& e) { return e.cause == cause; });
  }
  [[nodiscard]] long sent(CommandKind kind) const {
    return std::count_if(commands.begin(), commands.end(),
                         [kind](const Command& c) { return c.kind == kind; });
  }
  void come_home() {
    planning.stamp = now;
    planning.order = PlanningOrder::tour;
    planning.status = PlanningStatus::tour_complete;
    ASSERT_TRUE(run_to(MissionPhase::return_home, 1));
    planning.order = PlanningOrder::home;
    planning.status = PlanningStatus::home_reached;
  }

  MissionConfig config;
  Supervisor supervisor{SafetyConfig{}, config, motion::Geofence(motion::GeofenceConfig{})};
  Time now = kNanosecondsPerSecond, checker_died = 0;
  bool armed = false, taken_over = false, checker_lives = true, land_ordered = false;
  bool gives_back = true, answers = true, obeys_setpoints = true;
  VehicleMode mode = VehicleMode::idle;
  double height = 0, battery = 0.9;
  std::int64_t last_id = 0;
  std::vector<Order> given;
  std::vector<CommandAck> acks;
  PlanningReport planning;
  MissionOrders orders;
  OrderReply reply;
  std::vector<MissionEvent> events;
  std::vector<Command> commands;
  int anchors = 0;
};

class InFlight : public Orders {
 protected:
  void SetUp() override { ASSERT_TRUE(run_to(MissionPhase::tour)); }

  void lands_for_good_by(OrderKind kind) {
    EXPECT_EQ(order(kind).state, OrderState::accepted);
    EXPECT_EQ(phase(), MissionPhase::landing);
    EXPECT_EQ(orders, MissionOrders{});
    for (const OrderKind up : {OrderKind::hold, OrderKind::resume, OrderKind::return_home}) {
      EXPECT_EQ(order(up).state, OrderState::refused);
      EXPECT_EQ(phase(), MissionPhase::landing);
    }
    ASSERT_TRUE(run_to(MissionPhase::done));
    EXPECT_EQ(outcome(), Cause::ordered);
    EXPECT_EQ(order(OrderKind::resume).state, OrderState::refused);
  }
};

constexpr MissionOrders kHolds = {GuidanceOrder::hold, PlanningOrder::none};
constexpr MissionOrders kSilent = {};

TEST_F(InFlight, HoldStaysUntilResumeHoweverLongAndTheMissionSucceeds) {
  EXPECT_EQ(order(OrderKind::hold).state, OrderState::accepted);
  EXPECT_EQ(phase(), MissionPhase::hold);
  run(config.tour_s + 10);  // its deadline waits, too
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

// Somebody else flies.

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
