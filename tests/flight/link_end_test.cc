#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include <set>
#include <sstream>

#include "made_link.h"
#include "saker/core/error.h"

namespace saker::flight {
namespace {

using Texts = std::vector<std::string>;

class ALink : public MadeLink {
 protected:
  void SetUp() override {
    MadeLink::SetUp();
    robot.emplace(*this, "R1", 1, exchange::key_of(team, "R1").value());
    robots = {&*robot};
  }

  /// Seconds until what both say from now on arrives; a robot in flight says MISSION at 5 Hz.
  double back_after_s() {
    heard.clear();
    robot->heard.clear();
    const auto begun = now;
    while (now < begun + std::chrono::seconds(5)) {
      say(*robot->bus, "R1_MISSION", std::to_string(time()));
      say(*ground_bus, "R1_ORDER", std::to_string(time()));
      step();
      if (!on(heard, "R1_MISSION").empty() && !on(robot->heard, "R1_ORDER").empty()) break;
    }
    return std::chrono::duration<double>(now - begun).count();
  }

  std::optional<Robot> robot;
};

TEST_F(ALink, CarriesTelemetryUpAndOrdersDown) {
  run(1);
  say(*robot->bus, "R1_STATE", "a state");
  say(*robot->bus, "R1_MISSION", std::string("\0\xff", 2));
  say(*ground_bus, "R1_ORDER", "hold");
  heard.clear();
  robot->heard.clear();
  run(0.2);
  EXPECT_EQ(on(heard, "R1_STATE"), Texts{"a state"});
  EXPECT_EQ(on(heard, "R1_MISSION"), Texts{std::string("\0\xff", 2)});
  EXPECT_EQ(on(robot->heard, "R1_ORDER"), Texts{"hold"});
  EXPECT_EQ(ground->connected(), 1);
}

TEST_F(ALink, NothingThatMovesARobotOrThatItBelievesOfItselfGoesDown) {
  run(1);
  for (const char* suffix : {"_SETPOINT", "_COMMAND", "_VERDICT", "_STATE", "_TRAJECTORY"})
    say(*ground_bus, std::string("R1") + suffix, "x");
  run(1);
  EXPECT_TRUE(robot->heard.empty());
}

TEST_F(ALink, AGroundThatSaysMoreThanItMayIsNotBelieved) {
  run(1);
  exchange::Sealer sealer(team, "BASE", "");
  Session session(3, 1);
  const auto says = [&](const std::string& payload) {
    robot->end->receive(now, kGround, sealer.seal("R1_LINK", payload).value());
  };
  const auto stays_silent = [&] { return robot->end->counters().refused.asking; };
  // The robot hears another ground only after this one is silent.
  in_reach = false;
  run(4);
  const long before = stays_silent();
  says(session.payload(""));
  EXPECT_EQ(stays_silent(), before + 1);
  const auto answer = exchange::unsealed(team, "BASE", "R1_LINK", recorded.back().second);
  ASSERT_EQ(answer.verdict, exchange::Verdict::genuine);
  says(session.answer(answer));  // brings the challenge
  for (const char* suffix : {"_SETPOINT", "_COMMAND", "_STATE", "_VERDICT"})
    says(session.payload(to_bytes(Fragment{suffix, 1, 0, 1, "x"})));
  says(session.payload(to_bytes(Fragment{"_EXCHANGE", 1, 0, 60000, "x"})));
  says(session.payload("no fragment"));
  says(session.payload(to_bytes(Fragment{"_ORDER", 1, 0, 1, "hold"})));
  EXPECT_EQ(robot->end->counters().refused.without_right, 6);
  step();
  step();
  EXPECT_EQ(on(robot->heard, "R1_ORDER"), Texts{"hold"});
  EXPECT_EQ(robot->heard.size(), 1u);
}

TEST_F(ALink, ARobotSaysNothingInTheNameOfAnother) {
  Robot other(*this, "R2", 2, exchange::key_of(team, "R2").value());
  robots.push_back(&other);
  run(1);
  say(*robot->bus, "R2_STATE", "a lie");
  say(*other.bus, "R2_STATE", "the truth");
  run(1);
  EXPECT_EQ(on(heard, "R2_STATE"), Texts{"the truth"});
  EXPECT_EQ(ground->connected(), 2);
}

TEST_F(ALink, EachRobotHearsWhatIsForIt) {
  Robot other(*this, "R2", 2, exchange::key_of(team, "R2").value());
  robots.push_back(&other);
  run(1);
  say(*ground_bus, "R2_ORDER", "land");
  run(0.2);
  EXPECT_TRUE(on(robot->heard, "R2_ORDER").empty() && on(robot->heard, "R1_ORDER").empty());
  EXPECT_EQ(on(other.heard, "R2_ORDER"), Texts{"land"});
}

TEST_F(ALink, WhatCameUpIsNotSentDownAgain) {
  run(1);
  for (int i = 0; i < 100; ++i) say(*robot->bus, "R1_EXCHANGE", "chunk " + std::to_string(i));
  run(1);
  EXPECT_EQ(on(heard, "R1_EXCHANGE").size(), 100u);
  EXPECT_EQ(on(robot->heard, "R1_EXCHANGE").size(), 100u) << "its own, on its own LCM";
  EXPECT_EQ(ground->counters().echoes, 100);
  EXPECT_EQ(ground->counters().out_messages, 0);
}

TEST_F(ALink, BothEndsOnOneLcmCarryNothingRound) {
  run(1);
  say(*robot->bus, "R1_STATE", "once");
  for (int i = 0; i < 200; ++i) {
    step();
    for (const auto& [channel, text] : std::exchange(heard, {}))  // as if it were one LCM
      say(*robot->bus, channel, text);
  }
  EXPECT_EQ(robot->end->counters().out_messages, 1);
}

TEST_F(ALink, ATrajectoryOf180KilobytesArrivesWhole) {
  air.jitter_s = 0.02;
  air.repeated = 0.3;
  Robot other(*this, "R2", 2, exchange::key_of(team, "R2").value());
  robots.push_back(&other);
  run(1);
  std::string large(180'000, ' ');
  for (std::size_t i = 0; i < large.size(); ++i) large[i] = static_cast<char>(i % 251);
  say(*other.bus, "R2_TRAJECTORY", large);
  run(2);
  EXPECT_EQ(on(heard, "R2_TRAJECTORY"), Texts{large});
  say(*other.bus, "R2_TRAJECTORY", std::string(256 * 1024 + 1, 'x'));
  run(2);
  EXPECT_EQ(other.end->counters().oversized, 1);
  EXPECT_EQ(on(heard, "R2_TRAJECTORY").size(), 1u);
}

TEST_F(ALink, AtThirtyPercentLossWhatArrivesIsInOrderAndNothingComesTwice) {
  air = {.loss = 0.3, .repeated = 0.3, .delay_s = 0.005, .jitter_s = 0.05};
  Robot other(*this, "R2", 2, exchange::key_of(team, "R2").value());
  robots.push_back(&other);
  run(2);
  for (int i = 1000; i < 3000; ++i) {  // 20 s
    say(*other.bus, "R2_STATE", std::to_string(i));
    if (i % 10 == 0) say(*other.bus, "R2_EXCHANGE", std::to_string(i));
    step();
  }
  run(1);
  const Texts states = on(heard, "R2_STATE"), chunks = on(heard, "R2_EXCHANGE");
  EXPECT_TRUE(std::is_sorted(states.begin(), states.end()));
  EXPECT_GT(states.size(), 15u);  // 40 at 2 Hz
  EXPECT_EQ(std::set(states.begin(), states.end()).size(), states.size());
  EXPECT_GT(chunks.size(), 100u);  // of 200
  EXPECT_EQ(std::set(chunks.begin(), chunks.end()).size(), chunks.size());
}

TEST_F(ALink, WhileItIsGoneTheNewestIsKeptAndNothingElse) {
  run(1);
  in_reach = false;
  run(4);
  EXPECT_EQ(ground->connected(), 0);
  heard.clear();
  for (int i = 0; i < 1000; ++i) {
    say(*robot->bus, "R1_STATE", std::to_string(i));
    say(*robot->bus, "R1_EXCHANGE", std::to_string(i));
    say(*ground_bus, "R1_ORDER", std::to_string(i));
    step();
  }
  robot->heard.clear();
  heard.clear();
  in_reach = true;
  run(1);
  EXPECT_EQ(on(heard, "R1_STATE"), Texts{"999"});
  EXPECT_TRUE(on(heard, "R1_EXCHANGE").empty());
  EXPECT_TRUE(on(robot->heard, "R1_ORDER").empty());
  EXPECT_GE(robot->end->counters().nobody, 1000);
  EXPECT_GE(ground->counters().nobody, 900);
}

TEST_F(ALink, IsThereAgainSoonWhicheverEndWasRestarted) {
  run(1);
  start_ground();
  run(4.5);
  EXPECT_EQ(ground->connected(), 1);
  EXPECT_EQ(robot->end->connected(), 1);
  robot->start(*this);
  run(4.5);
  EXPECT_EQ(ground->connected(), 1);
  EXPECT_EQ(robot->end->connected(), 1);
  say(*robot->bus, "R1_STATE", "after");
  run(0.5);
  EXPECT_EQ(on(heard, "R1_STATE").back(), "after");
}

TEST_F(ALink, IsThereAgainAtOnceAfterAGoodbyeOfEitherEnd) {
  run(1);
  ground->say_goodbye();
  run(0.02);
  EXPECT_EQ(robot->end->connected(), 0);
  start_ground();
  EXPECT_LT(back_after_s(), 0.5);
  robot->end->say_goodbye();
  run(0.02);
  EXPECT_EQ(ground->connected(), 0);
  robot->start(*this);
  EXPECT_LT(back_after_s(), 0.5);
}

TEST_F(ALink, IsThereAgainAfterAMissedHelloWhicheverEndWasKilled) {
  run(1);
  (void)back_after_s();
  robot->start(*this);
  EXPECT_LT(back_after_s(), 1.6) << "a hello, two messages of the robot";
  start_ground();
  EXPECT_LT(back_after_s(), 1.6);
}

TEST_F(ALink, SaysThatThereIsASecondRobotOnlyWhereBothAreHeard) {
  std::ostringstream log;
  const auto before = spdlog::default_logger();
  spdlog::set_default_logger(std::make_shared<spdlog::logger>(
      "test", std::make_shared<spdlog::sinks::ostream_sink_mt>(log)));
  run(1);
  for (int kill = 0; kill < 2; ++kill) {
    robot->start(*this);
    (void)back_after_s();
  }
  EXPECT_EQ(log.str().find("a second R1"), std::string::npos) << log.str();
  Robot second(*this, "R1", 3, robot->key);
  robots.push_back(&second);
  run(5);
  EXPECT_NE(log.str().find("a second R1 at 10.76.1.4:4000"), std::string::npos) << log.str();
  spdlog::set_default_logger(before);
}

TEST_F(ALink, FollowsARobotToAnotherAddress) {
  run(1);
  robot->address.port = 5000;
  run(0.5);
  robot->heard.clear();
  say(*robot->bus, "R1_STATE", "from there");
  run(0.5);
  say(*ground_bus, "R1_ORDER", "hold");
  run(0.2);
  EXPECT_EQ(on(robot->heard, "R1_ORDER"), Texts{"hold"});
}

TEST_F(ALink, NextDueSaysWhenToCallAgain) {
  EXPECT_EQ(ground->next_due(), Steady::time_point::max());
  run(1);
  EXPECT_LE(robot->end->next_due(), now + std::chrono::seconds(1));
  EXPECT_LE(ground->next_due(), now + std::chrono::seconds(1));
}

TEST_F(ALink, FiguresFitHealth) {
  run(1);
  say(*robot->bus, "R1_STATE", "x");
  run(0.5);
  std::map<std::string, long> figures;
  for (const auto& [name, value] : health(ground->report())) {
    EXPECT_LE(name.size(), 24u);
    figures[name] = value;
  }
  EXPECT_EQ(figures.at("link_connected"), 1);
  EXPECT_EQ(figures.at("link_in_bytes"), 1);
}

std::string refusal(const LinkConfig& config, LinkEnd::End end, const exchange::Key& key = {}) {
  Bus bus = Bus::in_memory("R1");
  try {
    LinkEnd(config, end, key, bus, 1, [](const Address&, std::string_view) { return true; });
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(LinkConfiguration, TheDefaultsAreGood) {
  EXPECT_EQ(refusal({}, LinkEnd::End::ground), "");
  EXPECT_EQ(refusal({.ground = "10.0.0.1:7670"}, LinkEnd::End::robot), "");
}

TEST(LinkConfiguration, WhatMovesARobotIsRefusedOnTheWayDown) {
  for (const char* channel : {"_SETPOINT", "_VERDICT", "_COMMAND", "_STATE", "_ODOMETRY",
                              "_TRAJECTORY", "_COMMAND_ACK", "_PRESENCE", "_OBJECTS"}) {
    LinkConfig config;
    config.down.push_back({channel, 1});
    EXPECT_EQ(refusal(config, LinkEnd::End::ground),
              std::string("link.down: channel ") + channel + " must not pass to a robot");
  }
}

TEST(LinkConfiguration, WhatBelongsToOneMachineIsRefusedOnTheWayUp) {
  for (const char* channel : {"_PRESENCE", "_SCAN", "_OCCUPANCY", "_ORDER"}) {
    LinkConfig config;
    config.up.push_back({channel, 1});
    EXPECT_NE(refusal(config, LinkEnd::End::ground).find("must not pass"), std::string::npos);
  }
}

TEST(LinkConfiguration, WhatIsNoChannelOrNamedTwiceIsRefused) {
  for (const char* channel : {"", "STATE", "_.*", "_state", "R1_STATE", "_STATE"}) {
    LinkConfig config;
    config.up.push_back({channel, 1});
    EXPECT_NE(refusal(config, LinkEnd::End::ground), "") << channel;
  }
}

TEST(LinkConfiguration, AnOrderThatAnotherWouldReplaceIsRefused) {
  LinkConfig config;
  config.down.front().keep = 1;
  EXPECT_EQ(refusal(config, LinkEnd::End::ground),
            "link.down: channel _ORDER: keep 1, expected 2 or more: each order counts");
}

TEST(LinkConfiguration, ASilenceOfOneLostHelloIsNoLossOfTheLink) {
  LinkConfig config;
  config.lost_s = 2;
  EXPECT_EQ(refusal(config, LinkEnd::End::ground),
            "link.lost_s 2, expected 2.5 times link.hello_s or more");
  config.hello_s = 0.8;
  EXPECT_EQ(refusal(config, LinkEnd::End::ground), "");
}

TEST(LinkConfiguration, KnowsTheAddressesOfThisMachine) {
  for (const char* own : {"127.0.0.1:7670", "127.8.0.1:7670", "0.0.0.0:7670"})
    EXPECT_TRUE(is_own(address_of("link.ground", own))) << own;
  EXPECT_FALSE(is_own(address_of("link.ground", "203.0.113.1:7670")));
}

TEST(LinkConfiguration, AnAddressThatIsNoneIsRefused) {
  for (const char* ground : {"", "base", "10.0.0.1", "10.0.0.1:", "10.0.0.1:0", "10.0.0.1:70000",
                             "10.0.0.1:7670x", "10.0.0:7670", ":7670"}) {
    EXPECT_NE(refusal({.ground = ground}, LinkEnd::End::robot).find("expected ADDRESS:PORT"),
              std::string::npos)
        << ground;
  }
}

TEST(LinkConfiguration, AnotherRobotsKeyIsRefused) {
  const auto other = exchange::key_of({}, "R2").value();
  EXPECT_NE(refusal({.ground = "10.0.0.1:7670"}, LinkEnd::End::robot, other).find("that of R2"),
            std::string::npos);
}

}  // namespace
}  // namespace saker::flight
