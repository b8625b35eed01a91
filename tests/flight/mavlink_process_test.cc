#include "flight/mavlink/mavlink_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <pty.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>

#include "flight/bus/messages.h"
#include "flight/mavlink/host_clock.h"
#include "made_craft.h"
#include "saker/core/error.h"
#include "tools/sim/mavlink/autopilot.h"

/// The bridge's process on real LCM and real lines, in a network namespace of its own.
namespace saker::flight::mavlink {
namespace {

constexpr Time kMs = kNanosecondsPerSecond / 1000;
constexpr std::chrono::milliseconds kNoWait{0};

/// The simulator's autopilot at the end of a UDP line, as long awake as it needs to arm.
class AutopilotOnALine {
 public:
  explicit AutopilotOnALine(int port)
      : line_(parsed_address(fmt::format("udp:127.0.0.1:{}", port))),
        autopilot_(tools::quirks_of(Autopilot::ardupilot),
                   host_now() - 60 * kNanosecondsPerSecond) {}

  void step() {
    const Time now = host_now();
    line_.step(now);
    std::array<std::uint8_t, 2048> buffer;
    for (auto bytes = line_.read(buffer, now); !bytes.empty(); bytes = line_.read(buffer, now))
      autopilot_.hear_bytes(bytes, now);
    craft_.step(to_seconds(now - stepped_));
    stepped_ = now;
    autopilot_.step(now, craft_.state());
    craft_.obey(autopilot_.take_orders());
    for (const FrameBytes& frame : autopilot_.take_frames()) line_.write(frame.span());
  }

  [[nodiscard]] bool armed() const { return autopilot_.armed(); }
  [[nodiscard]] const Line& line() const { return line_; }

 private:
  Line line_;
  tools::SimulatedAutopilot autopilot_;
  tools::MadeCraft craft_;
  Time stepped_ = host_now();
};

MavlinkConfig config_on(int port) {
  MavlinkConfig config;
  config.line = fmt::format("udp:listen:{}", port);
  return config;
}

/// One robot's executive, bridge and autopilot. Both autopilots are system 1, both bridges 255.
struct Robot {
  Robot(const std::string& name, int port)
      : autopilot(port), bus({}, name), bridge(config_on(port), bus), executive({}, name) {
    executive.subscribe<vehicle_state_t>([this](const vehicle_state_t& message) {
      ++states;
      armed_said = message.armed != 0;
      return true;
    });
    executive.subscribe<command_ack_t>([this](const command_ack_t&) { return ++acks > 0; });
  }

  void step() {
    (void)bus.handle(kNoWait);
    bridge.step();
    autopilot.step();
    (void)executive.handle(kNoWait);
    if (host_now() < next_odometry_) return;
    next_odometry_ = host_now() + 10 * kMs;
    VehicleOdometry odometry;
    odometry.stamp = host_now();
    odometry.velocity.setZero();
    odometry.angular_velocity.setZero();
    odometry.covariance = Matrix6d::Identity() * 1e-4;
    odometry.status = VehicleOdometryStatus::ok;
    executive.publish(to_lcm(odometry));
  }

  AutopilotOnALine autopilot;
  Bus bus;
  MavlinkProcess bridge;
  Bus executive;
  int states = 0, acks = 0;
  bool armed_said = false;

 private:
  Time next_odometry_ = 0;
};

class MavlinkProcesses : public ::testing::Test {
 protected:
  void SetUp() override {
    const char* here = std::getenv("SAKER_NAMESPACE");
    if (!here || std::string(here) != "yes") GTEST_SKIP() << "runs in a namespace";
  }
};

template <class Done>
bool until(const Done& done, double seconds, std::initializer_list<Robot*> robots) {
  const Time end = host_now() + from_seconds(seconds);
  while (!done() && host_now() < end) {
    for (Robot* robot : robots) robot->step();
    ::usleep(500);
  }
  return done();
}

TEST_F(MavlinkProcesses, TwoRobotsOnOneMachineDoNotHearEachOther) {
  Robot one("R1", 14551), two("R2", 14552);
  const auto ready = [](const Robot& robot) {
    return robot.states > 0 && robot.bridge.bridge().autopilot().state().has_origin;
  };
  ASSERT_TRUE(until([&] { return ready(one) && ready(two); }, 20, {&one, &two}));
  Command command;
  command.stamp = host_now();
  command.id = 1;
  command.kind = CommandKind::arm;
  one.executive.publish(to_lcm(command));
  ASSERT_TRUE(until([&] { return one.armed_said; }, 20, {&one, &two}));
  until([] { return false; }, 1, {&one, &two});
  EXPECT_TRUE(one.autopilot.armed());
  EXPECT_FALSE(two.autopilot.armed());
  EXPECT_FALSE(two.armed_said);
  EXPECT_EQ(one.acks, 1);
  EXPECT_EQ(two.acks, 0);
  EXPECT_EQ(two.bridge.bridge().counters().commands, 0);
}

/// A port that listens hears whom it heard first: another robot's autopilot on it says nothing.
TEST_F(MavlinkProcesses, ASecondSenderOnALineIsNotHeard) {
  Robot robot("R1", 14553);
  ASSERT_TRUE(until([&] { return robot.states > 0; }, 20, {&robot}));
  AutopilotOnALine stranger(14553);
  const long frames = robot.bridge.bridge().reader().counters().frames;
  const Time end = host_now() + 2 * kNanosecondsPerSecond;
  while (host_now() < end) {
    stranger.step();
    robot.step();
    ::usleep(500);
  }
  EXPECT_GT(robot.bridge.bridge().reader().counters().frames, frames);
  EXPECT_EQ(stranger.line().counters().received, 0);
}

/// From an executive's publishing to ODOMETRY on the line: the bar is 2 ms, a busy machine
/// gets ten times that.
TEST_F(MavlinkProcesses, OdometryIsOnTheLineWithinMilliseconds) {
  Robot robot("R1", 14554);
  ASSERT_TRUE(until([&] { return robot.bridge.added().count() > 200; }, 30, {&robot}));
  std::printf("%s\n", robot.bridge.cost_text().c_str());
  EXPECT_LT(robot.bridge.added().quantile(0.5), 0.02);
}

TEST(MavlinkLines, OfTwoProgramsOnOneSerialPortTheSecondIsToldSo) {
  int ours = -1, theirs = -1;
  char name[64];
  ASSERT_EQ(::openpty(&ours, &theirs, name, nullptr, nullptr), 0);
  const Address address = parsed_address(fmt::format("serial:{}:230400", name));
  Line first(address), second(address);
  first.step(host_now());
  second.step(host_now());
  EXPECT_TRUE(first.is_open()) << first.fault();
  EXPECT_FALSE(second.is_open());
  EXPECT_NE(second.fault().find("another program has it"), std::string::npos) << second.fault();
  ::close(ours);
  ::close(theirs);
}

TEST_F(MavlinkProcesses, OfTwoProgramsOnOnePortTheSecondIsToldSo) {
  const Address address = parsed_address("udp:listen:14555");
  Line first(address), second(address);
  first.step(host_now());
  second.step(host_now());
  EXPECT_TRUE(first.is_open());
  EXPECT_NE(second.fault().find("the port is in use"), std::string::npos) << second.fault();
}

}  // namespace
}  // namespace saker::flight::mavlink
