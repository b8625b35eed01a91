#include "saker/autonomy/mission.h"

#include <gtest/gtest.h>

#include <functional>

namespace saker::autonomy {
namespace {

constexpr Time kStep = kNanosecondsPerSecond / 50;

/// A vehicle that does what it is told, and a mission that is stepped with it.
class MissionTest : public testing::Test {
 protected:
  /// Steps until the mission is in `phase`; false when it is not within so many seconds.
  bool fly_to(MissionPhase phase, double seconds = 60) {
    for (const Time end = now + from_seconds(seconds); now < end; now += kStep) {
      step();
      if (mission.phase() == phase) return true;
    }
    return false;
  }
  void fly(double seconds) {
    for (const Time end = now + from_seconds(seconds); now < end; now += kStep) step();
  }

  void step() {
    MissionInput input;
    input.now = now;
    input.vehicle.stamp = vehicle_answers ? now : 0;
    input.vehicle.armed = armed;
    input.odometry.T_odom_body.translation() = Eigen::Vector3d(0, 0, height);
    input.acks = std::exchange(acks, {});
    input.findings = findings;
    input.safety = safety;
    input.planning = planning;
    input.planning.stamp = now;
    input.planning.landing = {ground, NAN, input.odometry.T_odom_body.translation()};
    input.odometry.velocity.setZero();
    input.looked_up = looked_up;
    input.stop = stop;
    if (!plant_gone) plant_heard = now;
    input.plant_heard = plant_heard;
    input.land_ordered = land_ordered;
    input.marked = marked;
    const Mission::Output output = mission.step(input);
    orders = output.orders;
    anchored += output.anchor;
    for (const MissionEvent& event : output.events) events.push_back(event);
    if (output.command) obey(*output.command);
    if (climbs) height = std::min(3.0, height + 0.02);
    if (descends) height = std::max(0.0, height - 0.02);
    if (descends && height == 0) armed = false;
  }

  void obey(const Command& command) {
    commands.push_back(command);
    if (!vehicle_answers) return;
    const bool accepted = command.kind != refused_kind;
    acks.push_back({now, command.id, accepted, accepted ? "" : "not now"});
    if (!accepted) return;
    if (command.kind == CommandKind::arm) armed = true;
    climbs = command.kind == CommandKind::takeoff && can_climb;
    descends = command.kind == CommandKind::land;
  }

  void plan(PlanningOrder order, PlanningStatus status) {
    planning.stamp = now;
    planning.order = order;
    planning.status = status;
    planning.text = to_string(status);
  }
  bool said(Cause cause) const {
    return std::any_of(events.begin(), events.end(),
                       [cause](const MissionEvent& e) { return e.cause == cause; });
  }

  MissionConfig config;
  Mission mission{config};
  Time now = kNanosecondsPerSecond;
  bool armed = false, climbs = false, descends = false;
  bool vehicle_answers = true, can_climb = true, land_ordered = false, marked = true;
  std::optional<CommandKind> refused_kind;
  double height = 0;
  std::vector<CommandAck> acks;
  std::vector<Finding> findings;
  SafetyDecision safety;
  PlanningReport planning;
  GuidanceStop stop;
  Ground ground = Ground::fit;
  bool looked_up = true;
  bool plant_gone = false;
  Time plant_heard = 0;
  MissionOrders orders;
  std::vector<MissionEvent> events;
  std::vector<Command> commands;
  int anchored = 0;
};

TEST_F(MissionTest, FliesATourComesHomeAndLands) {
  ASSERT_TRUE(fly_to(MissionPhase::tour));
  EXPECT_EQ(anchored, 1);
  fly(5);
  EXPECT_EQ(orders, (MissionOrders{GuidanceOrder::follow, PlanningOrder::tour}));
  plan(PlanningOrder::tour, PlanningStatus::tour_complete);
  ASSERT_TRUE(fly_to(MissionPhase::return_home));
  fly(1);
  EXPECT_EQ(orders, (MissionOrders{GuidanceOrder::follow, PlanningOrder::home}));
  plan(PlanningOrder::home, PlanningStatus::home_reached);
  ASSERT_TRUE(fly_to(MissionPhase::done));
  EXPECT_TRUE(mission.succeeded());
  EXPECT_EQ(orders, MissionOrders{});
  EXPECT_EQ(commands.size(), 3u);
}

TEST_F(MissionTest, EveryTransitionIsAnEventWithACause) {
  ASSERT_TRUE(fly_to(MissionPhase::tour));
  plan(PlanningOrder::tour, PlanningStatus::tour_complete);
  ASSERT_TRUE(fly_to(MissionPhase::return_home));
  plan(PlanningOrder::home, PlanningStatus::home_reached);
  ASSERT_TRUE(fly_to(MissionPhase::done));
  MissionPhase phase = MissionPhase::preflight;
  for (const MissionEvent& event : events) {
    EXPECT_EQ(event.from, phase);
    EXPECT_NE(event.cause, Cause::none);
    EXPECT_FALSE(event.text.empty());
    phase = event.to;
  }
  EXPECT_EQ(phase, MissionPhase::done);
}

TEST_F(MissionTest, StaysOnTheGroundWhileSomethingIsMissing) {
  findings = {{Cause::lidar_silent, SafetyAction::hold, "no scan yet"}};
  ASSERT_TRUE(fly_to(MissionPhase::done, config.preflight_s + 1));
  EXPECT_EQ(mission.outcome(), Cause::preflight_deadline);
  EXPECT_FALSE(mission.succeeded());
  EXPECT_TRUE(commands.empty());
  EXPECT_EQ(events.back().text, "no take-off: lidar_silent: no scan yet");
  EXPECT_EQ(events.size(), 2u);  // said once, and the end
}

TEST_F(MissionTest, DoesNotArmBeforeTheFlightIsMarked) {
  marked = false;
  fly(config.preflight_s - 5);
  EXPECT_EQ(mission.phase(), MissionPhase::preflight);
  EXPECT_TRUE(said(Cause::ready));  // whereupon it is marked
  marked = true;
  ASSERT_TRUE(fly_to(MissionPhase::arming, 0.1));
}

// Hazard: Stages and links | a flight cannot be marked, so that a restart in the air would not know
//   of it | it does not arm | –
TEST_F(MissionTest, AFlightThatCannotBeMarkedIsNone) {
  marked = false;
  ASSERT_TRUE(fly_to(MissionPhase::done, config.preflight_s + 1));
  EXPECT_TRUE(commands.empty());
  EXPECT_EQ(mission.outcome(), Cause::preflight_deadline);
  EXPECT_EQ(events.back().text, "no take-off: the flight could not be marked");
}

// Hazard: Surroundings | the column over the take-off place is occupied, or neither seen nor stated
//   free | it does not take off (`takeoff_blocked`) | –
TEST_F(MissionTest, DoesNotArmBeforeSomebodyLookedUp) {
  looked_up = false;
  ASSERT_TRUE(fly_to(MissionPhase::done, config.preflight_s + 1));
  EXPECT_TRUE(commands.empty());
  EXPECT_EQ(events.back().text, "no take-off: nobody has looked at the column above");
}

TEST_F(MissionTest, WaitsUntilNothingHasBeenMissingForAWhile) {
  findings = {{Cause::lidar_silent, SafetyAction::hold, "no scan yet"}};
  fly(5);
  findings.clear();
  const Time clear = now;
  ASSERT_TRUE(fly_to(MissionPhase::arming));
  EXPECT_NEAR(to_seconds(now - clear), config.settle_s, 0.05);
}

/// An autopilot whose sensors settle is asked for a minute by the bridge.
TEST_F(MissionTest, AnArmingThatMayTakeLongerThanATakeOffIsWaitedFor) {
  config.command.deadline_s = 60;
  mission = Mission(config);
  vehicle_answers = false;
  ASSERT_TRUE(fly_to(MissionPhase::arming));
  fly(config.takeoff_s + 10);
  EXPECT_EQ(mission.phase(), MissionPhase::arming);
  vehicle_answers = true;
  EXPECT_TRUE(fly_to(MissionPhase::tour));
}

TEST_F(MissionTest, RepeatsACommandWithTheSameIdUntilTheDeadline) {
  vehicle_answers = false;
  ASSERT_TRUE(fly_to(MissionPhase::done));
  EXPECT_EQ(mission.outcome(), Cause::command_deadline);
  EXPECT_NEAR(static_cast<double>(commands.size()),
              config.command.deadline_s / config.command.repeat_s, 2);
  for (const Command& command : commands) EXPECT_EQ(command.id, commands.front().id);
}

TEST_F(MissionTest, ARefusedArmEndsItWithTheVehiclesReason) {
  refused_kind = CommandKind::arm;
  ASSERT_TRUE(fly_to(MissionPhase::done));
  EXPECT_EQ(mission.outcome(), Cause::command_refused);
  EXPECT_EQ(events.back().text, "arm: not now");
}

TEST_F(MissionTest, LandsWhenTheTakeoffDoesNotGetThere) {
  can_climb = false;
  ASSERT_TRUE(fly_to(MissionPhase::landing));
  EXPECT_EQ(mission.outcome(), Cause::takeoff_deadline);
  ASSERT_TRUE(fly_to(MissionPhase::done));
}

TEST_F(MissionTest, HoldsWhileSafetySaysSoAndGoesOn) {
  ASSERT_TRUE(fly_to(MissionPhase::tour));
  safety = {SafetyAction::hold, Cause::checker_silent, "no verdict"};
  ASSERT_TRUE(fly_to(MissionPhase::hold, 0.1));
  EXPECT_EQ(orders, (MissionOrders{GuidanceOrder::hold, PlanningOrder::none}));
  safety = {};
  ASSERT_TRUE(fly_to(MissionPhase::tour, 0.1));
  EXPECT_TRUE(said(Cause::recovered));
  EXPECT_EQ(anchored, 1);
}

TEST_F(MissionTest, BeginsAnewWhereItIsAfterItWasOffCourse) {
  ASSERT_TRUE(fly_to(MissionPhase::tour));
  safety = {SafetyAction::hold, Cause::off_course, "2 m off"};
  fly(1);
  safety = {};
  fly(1);
  EXPECT_EQ(anchored, 2);
}

TEST_F(MissionTest, HoldsOnlySoOften) {
  ASSERT_TRUE(fly_to(MissionPhase::tour));
  for (int i = 0; i <= config.most_holds; ++i) {
    EXPECT_EQ(mission.phase(), MissionPhase::tour);
    safety = {SafetyAction::hold, Cause::checker_silent, "no verdict"};
    fly(0.1);
    safety = {};
    fly(0.1);
  }
  EXPECT_EQ(mission.outcome(), Cause::too_many_holds);
  ASSERT_TRUE(fly_to(MissionPhase::done));
}

TEST_F(MissionTest, LandsFromAnywhereWhenSafetySaysSo) {
  for (const MissionPhase from : {MissionPhase::takeoff, MissionPhase::tour}) {
    mission = Mission(config);
    armed = climbs = descends = false;
    height = 0;
    safety = {};
    ASSERT_TRUE(fly_to(from));
    safety = {SafetyAction::land, Cause::battery_empty, "battery at 9 %"};
    ASSERT_TRUE(fly_to(MissionPhase::landing, 0.1));
    EXPECT_EQ(commands.back().kind, CommandKind::land);
    EXPECT_EQ(mission.outcome(), Cause::battery_empty);
    ASSERT_TRUE(fly_to(MissionPhase::done));
  }
}

TEST_F(MissionTest, GivesNoCommandWhenOdometryIsLost) {
  ASSERT_TRUE(fly_to(MissionPhase::tour));
  const std::size_t before = commands.size();
  safety = {SafetyAction::silence, Cause::odometry_lost, "no registered scan for 1 s"};
  ASSERT_TRUE(fly_to(MissionPhase::landing, 0.1));
  fly(1);
  EXPECT_EQ(commands.size(), before);
  EXPECT_EQ(orders.guidance, GuidanceOrder::silent);
  climbs = false;
  descends = true;  // by itself
  ASSERT_TRUE(fly_to(MissionPhase::done));
  EXPECT_EQ(mission.outcome(), Cause::odometry_lost);
}

TEST_F(MissionTest, ReturnsWithALowBattery) {
  ASSERT_TRUE(fly_to(MissionPhase::tour));
  safety = {SafetyAction::return_home, Cause::battery_low, "battery at 29 %"};
  ASSERT_TRUE(fly_to(MissionPhase::return_home, 0.1));
  fly(1);
  EXPECT_EQ(mission.phase(), MissionPhase::return_home);
  EXPECT_EQ(mission.outcome(), Cause::battery_low);
}

TEST_F(MissionTest, ReturnsWhenNothingIsReachableAndLandsWhenHomeIsNot) {
  ASSERT_TRUE(fly_to(MissionPhase::tour));
  plan(PlanningOrder::tour, PlanningStatus::nothing_reachable);
  ASSERT_TRUE(fly_to(MissionPhase::return_home));
  plan(PlanningOrder::home, PlanningStatus::home_unreachable);
  ASSERT_TRUE(fly_to(MissionPhase::landing));
  ASSERT_TRUE(fly_to(MissionPhase::done));
  EXPECT_EQ(mission.outcome(), Cause::nothing_reachable);
}

TEST_F(MissionTest, EndsWhenPlanningSaysNothingForEver) {
  ASSERT_TRUE(fly_to(MissionPhase::tour));
  EXPECT_TRUE(fly_to(MissionPhase::done, config.tour_s + config.return_s + 60));
  EXPECT_EQ(mission.outcome(), Cause::tour_deadline);
  EXPECT_TRUE(said(Cause::return_deadline));
}

TEST_F(MissionTest, DoesNotTakeAnOldReportForAnAnswerToItsOrder) {
  plan(PlanningOrder::home, PlanningStatus::home_reached);
  ASSERT_TRUE(fly_to(MissionPhase::tour));
  fly(2);
  EXPECT_EQ(mission.phase(), MissionPhase::tour);
}

TEST_F(MissionTest, TellsItToLandAgainAtEachDeadline) {
  ASSERT_TRUE(fly_to(MissionPhase::tour));
  refused_kind = CommandKind::land;
  land_ordered = true;
  fly(2 * config.landing_s + 1);
  EXPECT_EQ(mission.phase(), MissionPhase::landing);
  EXPECT_TRUE(said(Cause::landing_deadline));
  refused_kind.reset();
  ASSERT_TRUE(fly_to(MissionPhase::done, config.landing_s + 10));
  EXPECT_EQ(mission.outcome(), Cause::ordered);
}

TEST_F(MissionTest, EndsWhenVehicleAndLidarAreGoneWhileItLands) {
  ASSERT_TRUE(fly_to(MissionPhase::tour));
  plant_gone = true;
  vehicle_answers = false;
  fly(2 * config.gone_s);
  EXPECT_EQ(mission.phase(), MissionPhase::tour);  // the ladder decides when to land
  safety = {SafetyAction::silence, Cause::odometry_lost, "no registered scan"};
  ASSERT_TRUE(fly_to(MissionPhase::done, 1));
  EXPECT_FALSE(mission.succeeded());
  EXPECT_EQ(events.back().cause, Cause::vehicle_silent);
}

TEST_F(MissionTest, SaysOnceWhyGuidanceStoppedOnTheWay) {
  ASSERT_TRUE(fly_to(MissionPhase::tour));
  stop = {1, "blocked at (9.0, 0.0, 3.0)"};
  fly(1);
  EXPECT_EQ(std::count_if(events.begin(), events.end(),
                          [](const MissionEvent& e) { return e.cause == Cause::stopped; }),
            1);
  EXPECT_EQ(mission.phase(), MissionPhase::tour);
}

TEST_F(MissionTest, AHoldIsNotSaidTwice) {
  ASSERT_TRUE(fly_to(MissionPhase::tour));
  safety = {SafetyAction::hold, Cause::lidar_silent, "no scan"};
  ASSERT_TRUE(fly_to(MissionPhase::hold));
  stop = {1, "told to hold"};
  fly(1);
  EXPECT_FALSE(said(Cause::stopped));
}

TEST_F(MissionTest, AnOrderBeforeTakeoffEndsItOnTheGround) {
  fly(0.5);
  land_ordered = true;
  ASSERT_TRUE(fly_to(MissionPhase::done, 0.1));
  EXPECT_TRUE(commands.empty());
}

}  // namespace
}  // namespace saker::autonomy
