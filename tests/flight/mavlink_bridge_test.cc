#include <gtest/gtest.h>

#include "flight/mavlink/bridge.h"
#include "mavlink_autopilot.h"

namespace saker::flight::mavlink {
namespace {

using Target = SetPositionTargetLocalNed;

class MavlinkFlight : public ::testing::TestWithParam<Autopilot> {
 protected:
  Flown flown_{GetParam()};
};

TEST_P(MavlinkFlight, ArmsTakesOffAndFollowsSetpointsAndLands) {
  flown_.take_off();
  ASSERT_TRUE(flown_.in_air());
  EXPECT_FALSE(flown_.autopilot().cancelled() > 0);
  ASSERT_EQ(flown_.answers.size(), 2u);
  for (const auto& answer : flown_.answers) EXPECT_TRUE(answer.accepted) << answer.reason;
  EXPECT_EQ(flown_.bridge().vehicle_state(flown_.now())->mode, VehicleMode::hold);
  flown_.setpoints_run = true;
  flown_.run(1000 * kMs);
  const int before = flown_.sent<Target>();
  flown_.run(1000 * kMs);
  EXPECT_EQ(flown_.sent<Target>() - before, 50);
  EXPECT_FLOAT_EQ(flown_.last<Target>().vx, 0.5);
  EXPECT_EQ(flown_.bridge().vehicle_state(flown_.now())->mode, VehicleMode::guided);
  flown_.order(CommandKind::land);
  flown_.run(10'000 * kMs);
  EXPECT_FALSE(flown_.armed());
  EXPECT_TRUE(flown_.answers.back().accepted);
  EXPECT_EQ(flown_.bridge().vehicle_state(flown_.now())->mode, VehicleMode::idle);
  EXPECT_EQ(flown_.bridge().counters().not_finite, 0);
}

TEST_P(MavlinkFlight, ASetpointGoesOutInTheStepAfterItIsHeardAndNoTwoWithinTenMilliseconds) {
  flown_.take_off();
  flown_.setpoints_run = true;
  flown_.run(3000 * kMs);
  Setpoint setpoint;
  setpoint.position = flown_.craft().place();
  setpoint.velocity = setpoint.acceleration = Eigen::Vector3d::Zero();
  setpoint.yaw = 0;
  const auto sent_at = [&](Time now) {
    setpoint.stamp = now;
    setpoint.expiry = now + 200 * kMs;
    const long before = flown_.bridge().counters().setpoints;
    flown_.bridge().hear(setpoint, now);
    flown_.bridge().step(now, 0);
    return flown_.bridge().counters().setpoints - before;
  };
  EXPECT_EQ(sent_at(flown_.now() + 18 * kMs), 1);
  EXPECT_EQ(sent_at(flown_.now() + 27 * kMs), 0);
  EXPECT_EQ(sent_at(flown_.now() + 38 * kMs), 1);
}

TEST_P(MavlinkFlight, NoSetpointGoesOutBeforeTheTakeOffIsOrdered) {
  flown_.setpoints_run = true;
  flown_.run(3000 * kMs);
  flown_.order(CommandKind::arm);
  flown_.run(1000 * kMs);
  EXPECT_TRUE(flown_.armed());
  EXPECT_EQ(flown_.sent<Target>(), 0);
}

// Hazard: Autopilot | setpoints stop | a stop is sent within a tick | 2
TEST_P(MavlinkFlight, WhenSetpointsStopTheVehicleIsStoppedWithinATick) {
  flown_.take_off();
  flown_.setpoints_run = true;
  flown_.run(3000 * kMs);
  flown_.setpoints_run = false;
  flown_.run(220 * kMs);
  EXPECT_FLOAT_EQ(flown_.last<Target>().vx, 0);
  EXPECT_EQ(flown_.last<Target>().type_mask & 0x3F, 0);
  const auto state = flown_.bridge().vehicle_state(flown_.now());
  EXPECT_EQ(state->mode, VehicleMode::hold);
  EXPECT_TRUE(state->faults & kSetpointExpired);
}

// Hazard: Autopilot | odometry stops | LAND is ordered within 0.3 s, until it is answered | 2
TEST_P(MavlinkFlight, WithoutOdometryItIsToldToLandWithinThreeTenths) {
  flown_.take_off();
  flown_.setpoints_run = true;
  flown_.run(3000 * kMs);
  const std::size_t before = flown_.commands.size();
  flown_.odometry_runs = false;
  const Time stopped = flown_.now();
  flown_.run(300 * kMs);
  ASSERT_GT(flown_.commands.size(), before);
  EXPECT_EQ(flown_.commands.back().second, kDoSetMode);
  EXPECT_LE(flown_.commands.back().first - stopped, 300 * kMs);
  EXPECT_EQ(flown_.mode(), dialect_of(GetParam()).land.custom);
  EXPECT_EQ(flown_.bridge().cause(), "odometry is lost");
  const int targets = flown_.sent<Target>();
  flown_.run(10'000 * kMs);
  EXPECT_EQ(flown_.sent<Target>(), targets);
  EXPECT_FALSE(flown_.armed());
}

TEST_P(MavlinkFlight, ALandOrderThatIsNotAnsweredIsSentUntilItIs) {
  tools::Quirks patient = tools::quirks_of(GetParam());
  patient.lost_s = patient.setpoint_timeout_s = 1e9;  // it does not land by itself
  Flown flown(GetParam(), patient);
  flown.take_off();
  flown.silent = true;
  flown.odometry_runs = false;
  flown.run(10'000 * kMs);
  const auto tries = std::count_if(flown.commands.begin(), flown.commands.end(), [&](auto& c) {
    return c.second == kDoSetMode && c.first > flown.now() - 9000 * kMs;
  });
  EXPECT_GE(tries, 15);
  EXPECT_LE(tries, 25);
  flown.silent = false;
  flown.run(600 * kMs);
  EXPECT_EQ(flown.mode(), dialect_of(GetParam()).land.custom);
}

// Hazard: Autopilot | a pilot takes over | nothing that moves goes out any more; orders are refused
//   with that cause until an operator resumes | 2
TEST_P(MavlinkFlight, APilotHasItAtOnceAndForGood) {
  flown_.take_off();
  flown_.setpoints_run = true;
  flown_.run(3000 * kMs);
  flown_.autopilot().switch_mode(5);
  const int targets = flown_.sent<Target>();
  const std::size_t commands = flown_.commands.size();
  flown_.run(1000 * kMs);
  flown_.autopilot().switch_mode(dialect_of(GetParam()).hold.custom);  // the switch goes back
  flown_.run(1000 * kMs);
  flown_.order(CommandKind::hold);
  flown_.run(500 * kMs);
  EXPECT_EQ(flown_.sent<Target>(), targets);
  EXPECT_EQ(
      std::count_if(flown_.commands.begin() + static_cast<long>(commands), flown_.commands.end(),
                    [](auto& c) { return c.second != kSetMessageInterval; }),
      0);
  EXPECT_FALSE(flown_.answers.back().accepted);
  EXPECT_EQ(flown_.answers.back().reason, "the pilot took over, mode 5");
  EXPECT_TRUE(flown_.bridge().vehicle_state(flown_.now())->faults & kTakenOver);
}

TEST_P(MavlinkFlight, AnOperatorsResumeTakesItBackAndSetpointsMoveItAgain) {
  flown_.take_off();
  flown_.setpoints_run = true;
  flown_.run(3000 * kMs);
  flown_.autopilot().switch_mode(5);
  flown_.run(1000 * kMs);
  flown_.setpoints_run = false;  // the executive is silent, too
  flown_.order(CommandKind::resume);
  flown_.run(1500 * kMs);
  EXPECT_TRUE(flown_.answers.back().accepted) << flown_.answers.back().reason;
  EXPECT_FALSE(flown_.bridge().vehicle_state(flown_.now())->faults & kTakenOver);
  EXPECT_EQ(flown_.mode(), dialect_of(GetParam()).hold.custom);
  EXPECT_LT(flown_.craft().velocity().norm(), 0.1);  // nobody moves it yet
  flown_.setpoints_run = true;
  flown_.run(4000 * kMs);
  EXPECT_EQ(flown_.mode(), dialect_of(GetParam()).guided.custom);
  EXPECT_EQ(flown_.bridge().vehicle_state(flown_.now())->mode, VehicleMode::guided);
  EXPECT_GT(flown_.craft().velocity().x(), 0.3);
}

TEST_P(MavlinkFlight, AResumeThatIsHeardTwiceTakesNothingFromAPilotWhoCameBetween) {
  flown_.take_off();
  flown_.autopilot().switch_mode(5);
  flown_.run(1500 * kMs);
  flown_.order(CommandKind::resume);
  flown_.run(1500 * kMs);
  ASSERT_TRUE(flown_.bridge().authority().ours());
  flown_.autopilot().switch_mode(5);
  flown_.run(1500 * kMs);
  ASSERT_FALSE(flown_.bridge().authority().ours());
  flown_.order_again(CommandKind::resume);
  flown_.run(1500 * kMs);
  EXPECT_FALSE(flown_.bridge().authority().ours());
  flown_.order(CommandKind::resume);
  flown_.run(1500 * kMs);
  EXPECT_TRUE(flown_.bridge().authority().ours());
}

TEST_P(MavlinkFlight, AResumeThatTheAutopilotDoesNotAnswerLeavesItToThePilot) {
  flown_.take_off();
  flown_.autopilot().switch_mode(5);
  flown_.run(1500 * kMs);
  flown_.silent = true;
  flown_.order(CommandKind::resume);
  flown_.run(5000 * kMs);
  EXPECT_FALSE(flown_.answers.back().accepted);
  EXPECT_FALSE(flown_.bridge().authority().ours());
}

TEST_P(MavlinkFlight, AResetOfOdometryMovesTheHeldPlaceWithItAtOnce) {
  flown_.take_off();
  flown_.run(1000 * kMs);
  const float before = flown_.last<Target>().x;
  flown_.odom_offset = 3;
  flown_.reset_counter = 1;
  flown_.run(10 * kMs);
  EXPECT_NEAR(flown_.last<Target>().x, before + 3, 1e-3);
  EXPECT_EQ(flown_.last<Odometry>().reset_counter, 1);
  EXPECT_NEAR(flown_.last<Odometry>().x, before + 3, 1e-3);
  flown_.run(1000 * kMs);
  EXPECT_EQ(flown_.mode(), dialect_of(GetParam()).guided.custom);
}

TEST_P(MavlinkFlight, ArmingWaitsForSensorsThatSettle) {
  tools::Quirks quirks = tools::quirks_of(GetParam());
  quirks.checks = {{"Arm: Accels inconsistent", 34.5}, {"Arm: Gyros inconsistent", 36.5}};
  Flown flown(GetParam(), quirks);
  flown.run(3000 * kMs);  // 33 s since boot
  flown.order(CommandKind::arm);
  flown.run(3000 * kMs);
  EXPECT_TRUE(flown.answers.empty());
  flown.run(3000 * kMs);
  ASSERT_EQ(flown.answers.size(), 1u);
  EXPECT_TRUE(flown.answers[0].accepted);
}

TEST_P(MavlinkFlight, AnAutopilotThatIsSilentIsNoState) {
  flown_.run(3000 * kMs);
  EXPECT_TRUE(flown_.bridge().vehicle_state(flown_.now()));
  flown_.speaks = false;
  flown_.run(3000 * kMs);
  EXPECT_FALSE(flown_.bridge().vehicle_state(flown_.now()));
  flown_.order(CommandKind::arm);
  flown_.run(10 * kMs);
  EXPECT_EQ(flown_.answers.back().reason, "no autopilot is heard");
  const int beats = flown_.sent<Heartbeat>();
  flown_.run(5000 * kMs);
  EXPECT_EQ(flown_.sent<Heartbeat>() - beats, 5);
}

INSTANTIATE_TEST_SUITE_P(Both, MavlinkFlight,
                         ::testing::Values(Autopilot::ardupilot, Autopilot::px4),
                         [](const auto& kind) { return std::string(to_string(kind.param)); });

// Hazard: Autopilot | it refuses to arm | its text is the cause; what passes is tried for 60 s | –
TEST(MavlinkBridge, WhatDoesNotPassIsTheReasonOfTheRefusal) {
  tools::Quirks quirks = tools::quirks_of(Autopilot::ardupilot);
  quirks.checks = {{"PreArm: Battery 1 low voltage failsafe", 1e9}};
  Flown flown(Autopilot::ardupilot, quirks);
  flown.run(3000 * kMs);
  flown.order(CommandKind::arm);
  flown.run(1000 * kMs);
  ASSERT_EQ(flown.answers.size(), 1u);
  EXPECT_FALSE(flown.answers[0].accepted);
  EXPECT_EQ(flown.answers[0].reason, "PreArm: Battery 1 low voltage failsafe");
}

TEST(MavlinkBridge, AnotherAutopilotIsRefusedByName) {
  Flown flown(Autopilot::px4);
  Bridge& bridge = flown.bridge();
  Heartbeat message;
  message.autopilot = 3;
  FrameWriter writer(1, 1);
  bridge.hear_bytes(writer.write(message)->span(), flown.now(), 0);
  flown.speaks = false;
  flown.order(CommandKind::arm);
  flown.run(10 * kMs);
  ASSERT_EQ(flown.answers.size(), 1u);
  EXPECT_EQ(flown.answers[0].reason,
            "mavlink.autopilot is px4, but system 1 is ardupilot (HEARTBEAT 3)");
}

/// An order is sent again until its answer comes: PX4 climbs once.
TEST(MavlinkBridge, ATakeOffThatIsOrderedAgainIsAnsweredAgainAndNotFlownAgain) {
  Flown flown(Autopilot::px4);
  flown.take_off();
  ASSERT_EQ(flown.answers.size(), 2u);
  const double height = flown.craft().place().z();
  Command again;
  again.id = flown.answers.back().id;
  again.kind = CommandKind::takeoff;
  again.height_m = 3;
  flown.bridge().hear(again, flown.now());
  flown.run(5000 * kMs);
  ASSERT_EQ(flown.answers.size(), 3u);
  EXPECT_TRUE(flown.answers.back().accepted);
  EXPECT_NEAR(flown.craft().place().z(), height, 1e-3);
}

/// An origin that comes before the estimator runs is forgotten without a word.
TEST(MavlinkBridge, AsksForTheMessagesThatItNeedsAndForAnOriginUntilThereIsOne) {
  for (const Autopilot kind : {Autopilot::ardupilot, Autopilot::px4}) {
    tools::Quirks quirks = tools::quirks_of(kind);
    quirks.estimator_s = 32;
    Flown flown(kind, quirks);
    flown.run(1500 * kMs);
    EXPECT_EQ(flown.sent<CommandLong>(), 9);
    EXPECT_EQ(flown.sent<SetGpsGlobalOrigin>(), 2);
    EXPECT_EQ(flown.last<SetGpsGlobalOrigin>().latitude, 470000000);
    flown.run(8000 * kMs);
    EXPECT_TRUE(flown.autopilot().estimator().origin_set());
    EXPECT_EQ(flown.sent<SetGpsGlobalOrigin>(), 3);
  }
}

/// Two aircraft on one line, or two bridges on one machine.
TEST(MavlinkBridge, AnswersToOthersAreNotOurs) {
  Flown flown(Autopilot::ardupilot);
  flown.run(3000 * kMs);
  flown.silent = true;
  flown.order(CommandKind::disarm);
  flown.run(100 * kMs);
  flight::mavlink::CommandAck ack;
  ack.command = kArmDisarm;
  ack.target_system = 254;
  FrameWriter writer(1, 1), other(2, 1);
  flown.bridge().hear_bytes(writer.write(ack)->span(), flown.now(), 0);
  ack.target_system = 255;
  flown.bridge().hear_bytes(other.write(ack)->span(), flown.now(), 0);
  flown.run(100 * kMs);
  EXPECT_TRUE(flown.answers.empty());
  flown.bridge().hear_bytes(writer.write(ack)->span(), flown.now(), 0);
  flown.run(100 * kMs);
  EXPECT_EQ(flown.answers.size(), 1u);
}

// Hazard: Autopilot | odometry begins anew with another heading | ArduPilot, which keeps the old
//   one, is told to land; PX4 follows | 2
TEST(MavlinkBridge, AHeadingThatIsResetMakesArdupilotLand) {
  for (const Autopilot kind : {Autopilot::ardupilot, Autopilot::px4}) {
    Flown flown(kind);
    flown.take_off();
    VehicleOdometry turned = *flown.bridge().odometry().newest();
    turned.stamp += 10 * kMs;
    turned.reset_counter = 1;
    turned.T_odom_body.linear() =
        Eigen::AngleAxisd(0.35, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    flown.odometry_runs = false;
    flown.bridge().hear(turned, flown.now() + 5 * kMs);
    flown.run(100 * kMs);
    const bool landed = flown.mode() == dialect_of(kind).land.custom;
    EXPECT_EQ(landed, kind == Autopilot::ardupilot);
  }
}

/// Whatever bytes come: nothing throws, and nothing that moves goes out.
TEST(MavlinkBridge, MutatedStreamsMoveNothing) {
  Flown flown(Autopilot::ardupilot);
  flown.run(1000 * kMs);
  FrameWriter writer(1, 1);
  unsigned random = 1;
  const auto next = [&] { return random = random * 1664525u + 1013904223u, random >> 8; };
  for (int i = 0; i < 20'000; ++i) {
    Heartbeat message;
    message.autopilot = 3;
    message.custom_mode = 4;
    FrameBytes frame = *writer.write(message);
    for (unsigned k = next() % 4; k > 0; --k)
      frame.bytes[next() % frame.length] = static_cast<std::uint8_t>(next());
    flown.bridge().hear_bytes(frame.span(), flown.now(), 0);
    if (i % 100 == 0) flown.run(10 * kMs);
  }
  EXPECT_EQ(flown.sent<Target>(), 0);
}

}  // namespace
}  // namespace saker::flight::mavlink
