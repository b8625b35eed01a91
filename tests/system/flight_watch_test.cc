#include "tools/saker/faults/flight_watch.h"

#include <gtest/gtest.h>

#include <cmath>

namespace saker::tools {
namespace {

using autonomy::MissionPhase;

constexpr Time kBegin = 1000 * kNanosecondsPerSecond;

Fault fault(FaultKind kind, double at_s, double strength) {
  Fault made;
  made.kind = kind;
  made.at_s = at_s;
  made.lasts_s = 2;
  made.strength = strength;
  return made;
}

/// A vehicle that flies as it is told to, and what is said of it.
class Watched : public testing::Test {
 protected:
  void step(double t_s) {
    truth.stamp = kBegin + from_seconds(t_s);
    watch.on_step(truth, state);
  }
  void fly(double from_s, double to_s) {
    for (double t_s = from_s; t_s < to_s; t_s += 0.01) step(t_s);
  }
  void collide(double t_s) {
    ++truth.collisions;
    step(t_s);
  }
  void say(double t_s, MissionPhase to, autonomy::Cause cause, const std::string& text) {
    watch.on_event({kBegin + from_seconds(t_s), MissionPhase::tour, to, cause, text});
  }
  [[nodiscard]] bool broken(Invariant invariant) const {
    for (const Breach& breach : watch.breaches())
      if (breach.invariant == invariant) return true;
    return false;
  }

  FaultSchedule schedule;
  simulation::VehicleTruth truth{.stamp = kBegin, .airborne = true, .has_flown = true};
  VehicleState state{.armed = true, .mode = VehicleMode::guided};
  motion::GeofenceConfig fence{0.5, 12, {-20, -20, 20, -20, 20, 20, -20, 20}};
  FlightWatch watch{schedule, fence, motion::LimitsConfig{}, kBegin};
};

TEST_F(Watched, AnEvenFlightBreaksNothing) {
  truth.velocity = {1, 0, 0};
  fly(0, 5);
  EXPECT_TRUE(watch.breaches().empty());
}

TEST_F(Watched, ACollisionIsABreach) {
  truth.velocity = {1, 0, 0};
  fly(0, 1);
  collide(1);
  EXPECT_TRUE(broken(Invariant::no_collision));
}

TEST_F(Watched, ALorryThatDrivesIntoAVehicleAtRestIsUnavoidable) {
  schedule = {fault(FaultKind::lorry, 0, 3)};
  truth.velocity = {0.1, 0, 0};
  fly(0, 4);
  collide(4);
  EXPECT_FALSE(broken(Invariant::no_collision));
}

TEST_F(Watched, ALorryThatPushesAVehicleAwayCameToIt) {
  schedule = {fault(FaultKind::lorry, 0, 3)};
  fly(0, 3.8);
  truth.velocity = {4, 0, -7};
  fly(3.8, 4);
  collide(4);
  EXPECT_FALSE(broken(Invariant::no_collision));
}

TEST_F(Watched, WhatAVehicleHitsAfterALorryDroveIntoItCountsNoMore) {
  schedule = {fault(FaultKind::lorry, 0, 3)};
  fly(0, 4);
  collide(4);
  truth.velocity = {2, 0, 0};
  fly(4, 6);
  collide(6);
  EXPECT_FALSE(broken(Invariant::no_collision));
}

TEST_F(Watched, ALorryThatPassedLongAgoExcusesNothing) {
  schedule = {fault(FaultKind::lorry, 0, 3)};
  fly(0, 9);
  collide(9);
  EXPECT_TRUE(broken(Invariant::no_collision));
}

TEST_F(Watched, ALorryThatOvertakesAVehicleCameToIt) {
  schedule = {fault(FaultKind::lorry, 0, 4.6)};
  schedule[0].towards_deg = 47;
  truth.velocity = {1, 1, 0};
  for (double t_s = 0; t_s < 3; t_s += 0.01) {
    truth.T_world_body.translation() << 0.3 * t_s, 0.3 * t_s, 3;
    step(t_s);
  }
  collide(3);
  EXPECT_FALSE(broken(Invariant::no_collision));
}

/// It comes from ahead, whichever way the vehicle flies.
TEST_F(Watched, AVehicleThatFliesIntoALorryCouldHaveBraked) {
  schedule = {fault(FaultKind::lorry, 0, 3)};
  schedule[0].towards_deg = 180;
  truth.velocity = {1.5, 0, 0};
  fly(0, 4);
  collide(4);
  EXPECT_TRUE(broken(Invariant::no_collision));
}

TEST_F(Watched, AWallThatStandsThereTooLateIsUnavoidable) {
  schedule = {fault(FaultKind::wall, 3, 1.5)};
  truth.velocity = {2.5, 0, 0};
  fly(0, 3.5);
  collide(3.5);
  EXPECT_FALSE(broken(Invariant::no_collision));
}

TEST_F(Watched, AWallFarAheadIsNot) {
  schedule = {fault(FaultKind::wall, 3, 8)};
  truth.velocity = {2.5, 0, 0};
  fly(0, 6);
  collide(6);
  EXPECT_TRUE(broken(Invariant::no_collision));
}

TEST_F(Watched, WhoComesDownWithoutAPoseCannotChooseThePlace) {
  state.mode = VehicleMode::descend;
  truth.collisions = 1;
  truth.velocity = {0.4, 0, -0.7};
  step(1);
  EXPECT_FALSE(broken(Invariant::no_collision));
  truth.collisions = 2;
  truth.velocity = {1.5, 0, -0.7};
  step(2);
  EXPECT_TRUE(broken(Invariant::no_collision));
}

TEST_F(Watched, WhoAbortsByOrderLooksForNoPlace) {
  state.mode = VehicleMode::land;
  truth.velocity = {0.1, 0, -0.7};
  truth.collisions = 1;
  watch.on_reply({.order = {1, autonomy::OrderKind::abort},
                  .state = autonomy::OrderState::accepted,
                  .text = "comes down"});
  step(1);
  EXPECT_FALSE(broken(Invariant::no_collision));
}

TEST_F(Watched, WhoLandsByOrderLooks) {
  state.mode = VehicleMode::land;
  truth.velocity = {0.1, 0, -0.7};
  truth.collisions = 1;
  watch.on_reply({.order = {1, autonomy::OrderKind::land},
                  .state = autonomy::OrderState::accepted,
                  .text = "lands"});
  step(1);
  EXPECT_TRUE(broken(Invariant::no_collision));
}

TEST_F(Watched, WhoHoldsIsAtRestAfterTwoSeconds) {
  truth.velocity = {1, 0, 0};
  say(1, MissionPhase::hold, autonomy::Cause::lidar_silent, "no scan");
  fly(1, 2.9);
  EXPECT_FALSE(broken(Invariant::at_rest));
  fly(2.9, 3.2);
  EXPECT_TRUE(broken(Invariant::at_rest));
}

TEST_F(Watched, WhoBrakesInTimeIsAtRest) {
  truth.velocity = {1, 0, 0};
  say(1, MissionPhase::hold, autonomy::Cause::lidar_silent, "no scan");
  fly(1, 2);
  truth.velocity = {0.1, 0, 0};
  step(2);
  truth.velocity = {1, 0, 0};
  fly(2.1, 6);
  EXPECT_FALSE(broken(Invariant::at_rest));
}

TEST_F(Watched, WhoLandsNeedNotRest) {
  truth.velocity = {0, 0, -0.7};
  state.mode = VehicleMode::land;
  say(1, MissionPhase::landing, autonomy::Cause::battery_empty, "empty");
  fly(1, 6);
  EXPECT_FALSE(broken(Invariant::at_rest));
}

TEST_F(Watched, BeyondTheFenceItMayBrake) {
  truth.T_world_body.translation() << 20.9, 0, 3;
  truth.velocity = {1, 0, 0};
  step(1);
  EXPECT_FALSE(broken(Invariant::in_fence));
  truth.T_world_body.translation() << 22, 0, 3;
  step(2);
  EXPECT_TRUE(broken(Invariant::in_fence));
}

class WatchedOdometry : public Watched {
 protected:
  /// Flies with 1 m/s along x; odometry says more by `off`(t).
  void fly_with(double to_s, const std::function<double(double)>& off) {
    for (double t_s = 0; t_s < to_s; t_s += 0.01) {
      truth.T_world_body.translation() << t_s, 0, 3;
      step(t_s);
      VehicleOdometry odometry;
      odometry.stamp = truth.stamp;
      odometry.T_odom_body.translation() << t_s + off(t_s), 0, 3;
      odometry.covariance = Matrix6d::Identity() * kSd * kSd;
      odometry.status = status;
      watch.on_odometry(odometry);
    }
  }
  static constexpr double kSd = 0.03;
  VehicleOdometryStatus status = VehicleOdometryStatus::ok;
};

TEST_F(WatchedOdometry, ASlowDriftIsAsItIs) {
  fly_with(20, [](double t_s) { return 0.01 * t_s; });
  EXPECT_FALSE(broken(Invariant::honest_odometry));
}

TEST_F(WatchedOdometry, AJumpOfMoreThanFiveSdIsABreach) {
  fly_with(6, [](double t_s) { return t_s > 5 ? 0.3 : 0; });
  EXPECT_TRUE(broken(Invariant::honest_odometry));
}

TEST_F(WatchedOdometry, ThreeSdAreSoForASecondAtMost) {
  const double four_sd = 4 * kSd * std::sqrt(2.0);
  fly_with(6, [&](double t_s) { return t_s > 3 && t_s < 3.5 ? four_sd : 0; });
  EXPECT_FALSE(broken(Invariant::honest_odometry));
}

TEST_F(WatchedOdometry, ThreeSdForLongerAreABreach) {
  const double four_sd = 4 * kSd * std::sqrt(2.0);
  fly_with(6, [&](double t_s) { return t_s > 3 ? four_sd : 0; });
  EXPECT_TRUE(broken(Invariant::honest_odometry));
}

TEST_F(WatchedOdometry, WhoSaysThatItPredictsMayBeOff) {
  status = VehicleOdometryStatus::predicted;
  fly_with(6, [](double t_s) { return t_s > 5 ? 3 : 0; });
  EXPECT_FALSE(broken(Invariant::honest_odometry));
}

TEST_F(Watched, AnEndWithoutACauseIsABreach) {
  say(1, MissionPhase::landing, autonomy::Cause::battery_low, "at 29 %");
  EXPECT_FALSE(broken(Invariant::cause_said));
  say(2, MissionPhase::done, autonomy::Cause::none, "");
  EXPECT_TRUE(broken(Invariant::cause_said));
}

TEST_F(Watched, ARefusalWithoutACauseIsABreach) {
  watch.on_ack({.accepted = false, .reason = "is armed already"});
  watch.on_reply({{1, autonomy::OrderKind::land}, autonomy::OrderState::refused, "lands already"});
  autonomy::PlanningReport no_way;
  no_way.status = autonomy::PlanningStatus::refused;
  no_way.text = "no path";
  watch.on_plan(no_way, {});
  EXPECT_FALSE(broken(Invariant::cause_said));
  no_way.text = "";
  watch.on_plan(no_way, {});
  EXPECT_TRUE(broken(Invariant::cause_said));
}

TEST_F(Watched, ARefusedCommandAnOrderAndAScanNeedACauseToo) {
  FlightWatch others[] = {{schedule, fence, motion::LimitsConfig{}, kBegin},
                          {schedule, fence, motion::LimitsConfig{}, kBegin},
                          {schedule, fence, motion::LimitsConfig{}, kBegin}};
  others[0].on_ack({.accepted = false, .reason = ""});
  others[1].on_reply({{1, autonomy::OrderKind::land}, autonomy::OrderState::refused, ""});
  others[2].on_scan({});
  for (const FlightWatch& other : others) {
    ASSERT_EQ(other.breaches().size(), 1U);
    EXPECT_EQ(other.breaches().front().invariant, Invariant::cause_said);
  }
}

TEST_F(Watched, WithoutAnExecutiveItIsAtRestAfterTwoSeconds) {
  truth.velocity = {1, 0, 0};
  step(1);
  watch.on_executive_gone(kBegin + from_seconds(1));
  fly(1, 2.9);
  EXPECT_FALSE(broken(Invariant::at_rest));
  fly(2.9, 3.2);
  EXPECT_TRUE(broken(Invariant::at_rest));
}

TEST_F(Watched, AFileThatIsNotWholeIsABreach) {
  watch.on_torn_file("map.smap is not what was written to it");
  EXPECT_TRUE(broken(Invariant::whole_files));
}

TEST_F(Watched, TheDigestTellsPathsApart) {
  FlightWatch same{schedule, fence, motion::LimitsConfig{}, kBegin};
  step(1);
  same.on_step(truth, state);
  EXPECT_EQ(watch.digest(), same.digest());
  truth.T_world_body.translation().x() = 1e-15;
  step(2);
  truth.T_world_body.translation().x() = 0;
  same.on_step(truth, state);
  EXPECT_NE(watch.digest(), same.digest());
}

}  // namespace
}  // namespace saker::tools
