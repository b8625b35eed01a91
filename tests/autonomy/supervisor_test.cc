#include "saker/autonomy/supervisor.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

namespace saker::autonomy {
namespace {

constexpr Time kStep = kNanosecondsPerSecond / 50;

/// Everything comes in time but what is switched off; the vehicle obeys at once.
class SupervisorTest : public testing::Test {
 protected:
  void run(double seconds) {
    for (const Time end = now + from_seconds(seconds); now < end; now += kStep) step();
  }

  void step() {
    const auto heard = [this](Cause cause) { return off == cause ? stopped_at : now; };
    SupervisorInput input;
    input.now = now;
    input.heard = {.vehicle = heard(Cause::vehicle_silent),
                   .lidar = heard(Cause::lidar_silent),
                   .odometry = heard(Cause::odometry_stale),
                   .verdict = heard(Cause::checker_silent),
                   .occupancy = heard(Cause::occupancy_stale),
                   .mapping = heard(Cause::mapping_stale),
                   .planning = heard(Cause::planning_stale),
                   .guidance = heard(Cause::guidance_silent)};
    input.odometry.stamp = pose_stands ? stopped_at : now;
    input.vehicle.armed = armed;
    input.vehicle.battery_share = 0.9;
    input.odometry.status = VehicleOdometryStatus::ok;
    input.odometry.T_odom_body.translation() =
        Eigen::Vector3d(off == Cause::outside_geofence ? 120 : 0.0, 0, height);
    input.setpoint.emplace();
    input.setpoint->position = Eigen::Vector3d(off == Cause::off_course ? 5.0 : 0.0, 0, height);
    input.acks = std::exchange(acks, {});
    input.planning = planning;
    input.planning.stamp = now;
    input.planning.column = column;
    input.has_targets = true;
    input.classified_share = classified_share;
    const Mission::Output output = supervisor.step(input);
    orders = output.orders;
    for (const MissionEvent& event : output.events) last = event;
    if (output.command) obey(*output.command);
  }

  void obey(const Command& command) {
    acks.push_back({now, command.id, true, ""});
    armed = armed || command.kind == CommandKind::arm;
    if (command.kind == CommandKind::takeoff) height = MissionConfig{}.height_m;
  }

  MissionPhase phase() const { return supervisor.mission().phase(); }

  Supervisor supervisor{SafetyConfig{}, MissionConfig{},
                        motion::Geofence(motion::GeofenceConfig{})};
  Time now = kNanosecondsPerSecond, stopped_at = 0;
  Cause off = Cause::none;
  bool pose_stands = false;
  double classified_share = 0.6;
  bool armed = false;
  double height = 0;
  std::vector<CommandAck> acks;
  PlanningReport planning;
  TakeoffColumn column{TakeoffColumn::State::free};
  MissionOrders orders;
  MissionEvent last;
};

TEST_F(SupervisorTest, StaysOnTheGroundWhenSegmentationGivesNothingAClass) {
  classified_share = 0.001;
  run(MissionConfig{}.preflight_s + 1);
  EXPECT_EQ(phase(), MissionPhase::done);
  EXPECT_FALSE(armed);
  EXPECT_NE(last.text.find("nothing_classified: segmentation gives 0.1 %"), std::string::npos)
      << last.text;
}

TEST_F(SupervisorTest, StaysOnTheGroundUnderWhatWasSeenAboveOrWasNot) {
  column = {TakeoffColumn::State::occupied, 2.4};
  run(10);
  EXPECT_FALSE(armed);
  EXPECT_EQ(last.cause, Cause::takeoff_blocked);
  EXPECT_EQ(last.text, "takeoff_blocked: something is 2.4 m above it");
  column = {TakeoffColumn::State::unknown, 8.2};
  run(10);
  EXPECT_FALSE(armed);
  column = {TakeoffColumn::State::free};
  run(5);
  EXPECT_TRUE(armed);
}

TEST_F(SupervisorTest, AShareThatIsNotANumberIsNothing) {
  classified_share = NAN;
  run(MissionConfig{}.preflight_s + 1);
  EXPECT_FALSE(armed);
}

TEST_F(SupervisorTest, WhatIsSeenInFlightDoesNotMatterToIt) {
  run(5);
  ASSERT_EQ(phase(), MissionPhase::tour);
  classified_share = 0;
  run(5);
  EXPECT_EQ(phase(), MissionPhase::tour);
}

TEST_F(SupervisorTest, OdometryThatWasLostIsNotFlownByAgain) {
  run(5);
  ASSERT_EQ(phase(), MissionPhase::tour);
  off = Cause::odometry_stale;
  stopped_at = now;
  run(SafetyConfig{}.odometry_lost_s + 0.2);
  ASSERT_EQ(phase(), MissionPhase::landing);
  off = Cause::none;
  run(SafetyConfig{}.recover_s + 5);
  EXPECT_EQ(phase(), MissionPhase::landing);
  EXPECT_EQ(orders, MissionOrders{});
  EXPECT_EQ(supervisor.mission().outcome(), Cause::odometry_lost);
}

struct Stall {
  Cause cause;
  double limit_s;  ///< after which it holds
};

class AStageThatStallsForEver : public SupervisorTest, public testing::WithParamInterface<Stall> {};

TEST_P(AStageThatStallsForEver, HoldsThenLands) {
  run(5);
  ASSERT_EQ(phase(), MissionPhase::tour);
  off = GetParam().cause;
  stopped_at = now;
  run(GetParam().limit_s + 0.1);
  ASSERT_EQ(phase(), MissionPhase::hold);
  EXPECT_EQ(last.cause, GetParam().cause);
  run(SafetyConfig{}.land_after_s - 0.3);
  EXPECT_EQ(phase(), MissionPhase::hold);
  run(0.4);
  EXPECT_EQ(phase(), MissionPhase::landing);
  EXPECT_EQ(last.cause, GetParam().cause);
}

INSTANTIATE_TEST_SUITE_P(
    All, AStageThatStallsForEver,
    testing::Values(Stall{Cause::checker_silent, 0.5}, Stall{Cause::occupancy_stale, 2},
                    Stall{Cause::mapping_stale, 5}, Stall{Cause::planning_stale, 4},
                    Stall{Cause::guidance_silent, 0.5}),
    [](const auto& stall) { return std::string(to_string(stall.param.cause)); });

TEST_F(SupervisorTest, APoseThatStandsStillIsNotFlownBy) {
  run(5);
  ASSERT_EQ(phase(), MissionPhase::tour);
  pose_stands = true;
  stopped_at = now;
  run(SafetyConfig{}.odometry_s + 0.1);
  EXPECT_EQ(phase(), MissionPhase::hold);
  run(SafetyConfig{}.odometry_lost_s - SafetyConfig{}.odometry_s);
  EXPECT_EQ(phase(), MissionPhase::landing);
  EXPECT_EQ(supervisor.mission().outcome(), Cause::odometry_lost);
}

/// Causes that can pass away, and how long they last here: longer than the limit, not for good.
struct Passing {
  Cause cause;
  double lasts_s;
};

class PassingCause : public SupervisorTest, public testing::WithParamInterface<Passing> {
 protected:
  void hold_and_recover(MissionPhase interrupted) {
    ASSERT_EQ(phase(), interrupted);
    const MissionOrders before = orders;
    off = GetParam().cause;
    stopped_at = now;
    run(GetParam().lasts_s);
    EXPECT_EQ(phase(), MissionPhase::hold);
    EXPECT_EQ(orders, (MissionOrders{GuidanceOrder::hold, PlanningOrder::none}));
    EXPECT_EQ(last.cause, GetParam().cause);
    off = Cause::none;
    run(SafetyConfig{}.recover_s + 0.1);
    EXPECT_EQ(phase(), interrupted);
    EXPECT_EQ(last.cause, Cause::recovered);
    EXPECT_EQ(orders, before);
    run(SafetyConfig{}.land_after_s);
    EXPECT_EQ(phase(), interrupted);
  }
};

TEST_P(PassingCause, LeadsBackToTheTour) {
  run(5);
  hold_and_recover(MissionPhase::tour);
}

TEST_P(PassingCause, LeadsBackToTheWayHome) {
  run(5);
  planning.order = PlanningOrder::tour;
  planning.status = PlanningStatus::tour_complete;
  run(0.1);
  hold_and_recover(MissionPhase::return_home);
}

INSTANTIATE_TEST_SUITE_P(
    All, PassingCause,
    testing::Values(Passing{Cause::vehicle_silent, 0.8}, Passing{Cause::lidar_silent, 0.8},
                    Passing{Cause::odometry_stale, 0.8}, Passing{Cause::checker_silent, 3},
                    Passing{Cause::occupancy_stale, 4}, Passing{Cause::mapping_stale, 7},
                    Passing{Cause::planning_stale, 6}, Passing{Cause::guidance_silent, 1},
                    Passing{Cause::outside_geofence, 1}, Passing{Cause::off_course, 1}),
    [](const auto& passing) { return std::string(to_string(passing.param.cause)); });

}  // namespace
}  // namespace saker::autonomy
