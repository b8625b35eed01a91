#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "flight/mavlink/bridge.h"
#include "mavlink_autopilot.h"

/// What goes wrong about the bridge, in made time: the real bridge, the simulator's autopilot, a
/// made vehicle that is on its way at half a metre a second. mavlink_fault_process_test.py kills
/// processes.
namespace saker::flight::mavlink {
namespace {

using Target = SetPositionTargetLocalNed;

constexpr double kAtRest = 0.2;  // m/s
constexpr double kSettled = 2;   // s
constexpr std::uint32_t kLoiter = 5;

class MavlinkFault : public ::testing::TestWithParam<Autopilot> {
 protected:
  void SetUp() override {
    flown_.take_off();
    flown_.setpoints_run = true;
    flown_.run(4000 * kMs);
    ASSERT_TRUE(flown_.in_air());
    ASSERT_GT(flown_.craft().velocity().norm(), 0.4);
  }

  [[nodiscard]] bool calm() {
    return flown_.craft().velocity().norm() < kAtRest || landing() || !flown_.armed();
  }
  [[nodiscard]] bool landing() { return flown_.mode() == dialect_.land.custom; }
  [[nodiscard]] bool told(VehicleFault fault) {
    const auto state = flown_.bridge().vehicle_state(flown_.now());
    return state && (state->faults & fault) != 0;
  }

  /// s until it is at rest, landing or has landed, and stays so until `watched` is over.
  double settles(double watched) {
    const Time begin = flown_.now();
    Time busy = begin;
    while (flown_.now() < begin + from_seconds(watched)) {
      flown_.run(10 * kMs);
      if (!calm()) busy = flown_.now();
    }
    const double seconds = to_seconds(busy - begin);
    fmt::print("at rest, landing or landed after {:.2f} s\n", seconds);
    return seconds;
  }
  /// For so long setpoints stay away before the autopilot acts by itself.
  [[nodiscard]] double own_timeout() const {
    return tools::quirks_of(GetParam()).setpoint_timeout_s;
  }

  Flown flown_{GetParam()};
  Dialect dialect_ = dialect_of(GetParam());
};

// Hazard: Autopilot | the bridge dies | the autopilot's own time-outs: ArduPilot stands after
//   0.5 s and lands after 5 s, PX4 lands after 1 s | 2
TEST_P(MavlinkFault, WhenTheBridgeDiesTheAutopilotStandsOrLandsByItsOwnTimeouts) {
  flown_.bridge_lives = false;
  EXPECT_LT(settles(6), own_timeout() + 1);
  flown_.run(18'000 * kMs);
  EXPECT_FALSE(flown_.armed());
  EXPECT_NEAR(flown_.craft().place().z(), 0, 0.1);
}

// Hazard: Autopilot | the line is cut for 0.2 s | the flight goes on | –
TEST_P(MavlinkFault, ACutOfAFifthOfASecondIsFlownOver) {
  flown_.line_cut = true;
  flown_.run(200 * kMs);
  flown_.line_cut = false;
  flown_.run(1000 * kMs);
  EXPECT_EQ(flown_.mode(), dialect_.guided.custom);
  EXPECT_TRUE(flown_.bridge().authority().ours());
  EXPECT_EQ(flown_.bridge().counters().losses, 0);
  EXPECT_GT(flown_.craft().velocity().norm(), 0.4);
}

// Hazard: Autopilot | the line is cut for 2 s | ArduPilot stands after 0.5 s and goes on; PX4
//   lands after 1 s, which the executive is told of | 2
TEST_P(MavlinkFault, ACutOfTwoSecondsEndsInGuidedFlightOrInALandingThatIsTold) {
  flown_.line_cut = true;
  EXPECT_LT(settles(2), own_timeout() + 1);
  flown_.line_cut = false;
  flown_.run(2000 * kMs);
  const bool goes_on = GetParam() == Autopilot::ardupilot;
  EXPECT_EQ(flown_.bridge().authority().ours(), goes_on) << flown_.bridge().cause();
  EXPECT_EQ(told(kTakenOver), !goes_on);
  EXPECT_EQ(landing(), !goes_on);
  if (goes_on)
    EXPECT_GT(flown_.craft().velocity().norm(), 0.4);
  else
    EXPECT_NE(flown_.bridge().cause().find("failsafe of the autopilot"), std::string::npos);
}

// Hazard: Autopilot | the line is cut for 20 s | no `_STATE` after 2.5 s; the autopilot stands or
//   lands by itself and nothing that moves is sent when the line is back | 2
TEST_P(MavlinkFault, ACutOfTwentySecondsEndsOnTheGround) {
  flown_.line_cut = true;
  EXPECT_LT(settles(3), own_timeout() + 1);
  EXPECT_FALSE(flown_.bridge().vehicle_state(flown_.now()));
  flown_.run(17'000 * kMs);
  const int targets = flown_.sent<Target>();
  flown_.line_cut = false;
  flown_.run(10'000 * kMs);
  EXPECT_TRUE(flown_.bridge().vehicle_state(flown_.now()));
  EXPECT_EQ(flown_.sent<Target>(), targets);
  EXPECT_FALSE(flown_.armed());
}

// Hazard: Autopilot | the executive dies behind a bridge | LAND is ordered within 0.3 s | 2
TEST_P(MavlinkFault, WithoutTheExecutiveItIsToldToLand) {
  flown_.setpoints_run = flown_.odometry_runs = false;
  const Time died = flown_.now();
  EXPECT_LT(settles(3), kSettled);
  EXPECT_TRUE(landing());
  EXPECT_EQ(flown_.commands.back().second, kDoSetMode);
  EXPECT_LE(flown_.commands.back().first - died, 300 * kMs);
  EXPECT_EQ(flown_.bridge().cause(), "odometry is lost");
  EXPECT_TRUE(told(kNoOdometry));
}

// Hazard: Autopilot | odometry says that it moves and stays where it is | LAND is ordered | 2
TEST_P(MavlinkFault, OdometryThatFreezesMakesItLand) {
  flown_.odometry_stands = true;
  EXPECT_LT(settles(3), kSettled);
  EXPECT_TRUE(landing());
  EXPECT_GT(flown_.bridge().odometry().counters().lies, 0);
  EXPECT_EQ(flown_.bridge().cause(), "odometry is lost");
}

// Hazard: Autopilot | odometry jumps by metres and says of no reset | it is not passed on; LAND
//   is ordered | 2
TEST_P(MavlinkFault, OdometryThatJumpsWithoutAResetMakesItLand) {
  flown_.odom_offset = 5;
  const float before = flown_.last<Odometry>().x;
  flown_.run(200 * kMs);
  EXPECT_NEAR(flown_.last<Odometry>().x, before, 0.2);
  EXPECT_LT(settles(3), kSettled);
  EXPECT_TRUE(landing());
  EXPECT_EQ(flown_.bridge().cause(), "odometry is lost");
}

// Hazard: Autopilot | odometry begins anew on the way | reset counter and setpoints move in the
//   same tick: it does not fly the jump back | –
TEST_P(MavlinkFault, AResetOnTheWayIsNotFlownBack) {
  const Eigen::Vector3d begin = flown_.craft().place();
  flown_.odom_offset = 5;
  flown_.reset_counter = 1;
  flown_.run(2000 * kMs);
  const Eigen::Vector3d moved = flown_.craft().place() - begin;
  EXPECT_EQ(flown_.bridge().counters().losses, 0) << flown_.bridge().cause();
  EXPECT_EQ(flown_.mode(), dialect_.guided.custom);
  EXPECT_GT(moved.x(), 0);
  EXPECT_LT(moved.norm(), 1.5);
}

// Hazard: Autopilot | it leaves guided flight by itself | the executive is told at once, nothing
//   that moves is sent until an operator resumes | 2
TEST_P(MavlinkFault, AnAutopilotThatLeavesGuidedByItselfHasItUntilAnOperatorResumes) {
  flown_.autopilot().switch_mode(kLoiter, true);
  flown_.run(20 * kMs);
  EXPECT_TRUE(told(kTakenOver));
  EXPECT_EQ(flown_.bridge().cause(), "failsafe of the autopilot, mode 5");
  const int targets = flown_.sent<Target>();
  EXPECT_LT(settles(3), kSettled);
  EXPECT_EQ(flown_.sent<Target>(), targets);
  flown_.order(CommandKind::resume);
  flown_.run(4000 * kMs);
  EXPECT_TRUE(flown_.answers.back().accepted) << flown_.answers.back().reason;
  EXPECT_FALSE(told(kTakenOver));
  EXPECT_GT(flown_.craft().velocity().norm(), 0.4);
}

// Hazard: Autopilot | its battery is low | the executive is told within 1.5 s, as by `_STATE` | –
TEST_P(MavlinkFault, ALowBatteryIsTold) {
  EXPECT_FALSE(told(kBatteryLow));
  flown_.battery_share = 0.1;
  flown_.run(1500 * kMs);
  EXPECT_TRUE(told(kBatteryLow));
  EXPECT_NEAR(flown_.bridge().vehicle_state(flown_.now())->battery_share, 0.1, 0.01);
}

// Hazard: Autopilot | it reboots in the air | `_STATE` says not armed within 1 s; nothing that
//   moves is sent | –
TEST_P(MavlinkFault, ARebootInTheAirIsToldAndNothingMovesFromThenOn) {
  flown_.reboot();
  flown_.run(1500 * kMs);
  EXPECT_FALSE(flown_.bridge().vehicle_state(flown_.now())->armed);
  const int targets = flown_.sent<Target>();
  flown_.run(5000 * kMs);
  EXPECT_EQ(flown_.sent<Target>(), targets);
}

// Hazard: Autopilot | it reboots on the ground | origin and messages are asked for anew; it arms
//   when its sensors have settled | –
TEST_P(MavlinkFault, ARebootOnTheGroundIsLikeAStart) {
  Flown flown(GetParam());
  flown.run(4000 * kMs);
  flown.reboot();
  flown.order(CommandKind::arm);
  flown.run(40'000 * kMs);
  EXPECT_EQ(flown.bridge().time_sync().restarts(), 1);
  EXPECT_TRUE(flown.bridge().autopilot().state().has_origin);
  ASSERT_EQ(flown.answers.size(), 1U);
  EXPECT_TRUE(flown.answers[0].accepted) << flown.answers[0].reason;
}

INSTANTIATE_TEST_SUITE_P(Both, MavlinkFault,
                         ::testing::Values(Autopilot::ardupilot, Autopilot::px4),
                         [](const auto& kind) { return std::string(to_string(kind.param)); });

/// Two robots on one radio: whoever speaks, each bridge knows one autopilot.
TEST(MavlinkTwoRobots, OnOneLineEachBridgeHearsAndOrdersItsOwnAutopilot) {
  constexpr Time kNow = 100 * kNanosecondsPerSecond;
  BridgeConfig config;
  config.autopilot_system = 2;
  config.system = 254;
  Bridge second(config);
  FrameWriter first_autopilot(1, 1), second_autopilot(2, 1);
  Heartbeat message;
  message.autopilot = 3;
  second.hear_bytes(first_autopilot.write(message)->span(), kNow, 0);
  EXPECT_FALSE(second.vehicle_state(kNow));
  second.hear_bytes(second_autopilot.write(message)->span(), kNow, 0);
  ASSERT_TRUE(second.vehicle_state(kNow));
  message.base_mode = kArmedFlag;
  second.hear_bytes(first_autopilot.write(message)->span(), kNow, 0);
  EXPECT_FALSE(second.vehicle_state(kNow)->armed);
  second.hear({.stamp = kNow, .id = 1, .kind = CommandKind::land, .height_m = NAN}, kNow);
  second.step(kNow, 0);
  FrameReader reader;
  int orders = 0;
  for (const FrameBytes& frame : second.take_frames()) {
    (void)reader.push(frame.span());
    while (const auto read = reader.next()) {
      EXPECT_EQ(read->system, 254);
      if (read->id != CommandLong::kId) continue;
      ++orders;
      EXPECT_EQ(decode<CommandLong>(read->bytes()).target_system, 2);
    }
  }
  EXPECT_GT(orders, 0);
}

}  // namespace
}  // namespace saker::flight::mavlink
