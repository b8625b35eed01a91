#include <fmt/format.h>

#include "made_link.h"

namespace saker::flight {
namespace {

/// What somebody without the key can do with the radio.
class AnAttacker : public MadeLink {
 protected:
  void SetUp() override {
    MadeLink::SetUp();
    robot.emplace(*this, "R1", 1, exchange::key_of(team, "R1").value());
    robots = {&*robot};
    for (int i = 0; i < 300; ++i) {
      say(*robot->bus, "R1_STATE", "secret " + std::to_string(i));
      say(*robot->bus, "R1_EXCHANGE", "secret " + std::to_string(i));
      step();
    }
    run(1);
    heard.clear();
    robot->heard.clear();
  }

  const Address elsewhere{0x0A4C01FF, 666};
  std::optional<Robot> robot;
};

TEST_F(AnAttacker, ReadsNothingButTheRobotsName) {
  ASSERT_GT(recorded.size(), 300u);
  for (const auto& [from, datagram] : recorded) {
    for (const char* text : {"secret", "STATE", "EXCHANGE", "LINK"})
      ASSERT_EQ(datagram.find(text), std::string::npos);
  }
}

TEST_F(AnAttacker, ReplaysInVainToWhoIsThere) {
  const std::vector<Datagram> all = recorded;
  for (const auto& [from, datagram] : all) {
    ground->receive(now, elsewhere, datagram);
    robot->end->receive(now, kGround, datagram);
  }
  run(1);
  EXPECT_TRUE(heard.empty());
  EXPECT_TRUE(robot->heard.empty());
  EXPECT_EQ(ground->counters().refused.replayed, static_cast<long>(all.size()));
  EXPECT_EQ(ground->connected(), 1);
}

TEST_F(AnAttacker, ReplaysInVainToARestartedGround) {
  const std::vector<Datagram> all = recorded;
  in_reach = false;
  start_ground();
  for (int again = 0; again < 3; ++again) {
    for (const auto& [from, datagram] : all) ground->receive(now, elsewhere, datagram);
    run(1);
  }
  EXPECT_TRUE(heard.empty());
  EXPECT_EQ(ground->connected(), 0);
  EXPECT_EQ(ground->counters().refused.asking, 3 * static_cast<long>(all.size()));
  in_reach = true;
  run(5);
  EXPECT_EQ(ground->connected(), 1) << "the robot itself is taken";
  for (const auto& [from, datagram] : all) ground->receive(now, elsewhere, datagram);
  say(*robot->bus, "R1_STATE", "alive");
  run(1);
  EXPECT_EQ(on(heard, "R1_STATE"), std::vector<std::string>{"alive"});
  EXPECT_TRUE(on(heard, "R1_EXCHANGE").empty());
}

TEST_F(AnAttacker, DrawsFewAnswersFromAFloodOfRecordings) {
  const std::vector<Datagram> all = recorded;
  in_reach = false;
  start_ground();
  answered.clear();
  for (const auto& [from, datagram] : all) ground->receive(now, elsewhere, datagram);
  EXPECT_EQ(answered.size(), 1u);
}

TEST_F(AnAttacker, KeepsNoRobotOutByAFloodOfRecordings) {
  const std::vector<Datagram> all = recorded;
  start_ground();
  robot->start(*this);
  std::size_t k = 0;
  for (int step_10ms = 0; step_10ms < 150; ++step_10ms) {
    for (int i = 0; i < 10; ++i, ++k) {  // a moment before whatever the robot says
      const Address from{elsewhere.ip, static_cast<std::uint16_t>(1000 + k % 500)};
      ground->receive(now + std::chrono::milliseconds(9), from, all[k % all.size()].second);
    }
    step();
  }
  EXPECT_EQ(ground->connected(), 1);
  EXPECT_EQ(robot->end->connected(), 1);
}

TEST_F(AnAttacker, ForgesInVain) {
  exchange::Key other = team;
  other[3] ^= 1;
  exchange::Sealer stranger(other, "R1", "");
  core::Rng rng(1);
  const std::size_t count = recorded.size();
  for (std::size_t i = 0; i < count; ++i) {
    std::string altered = recorded[i].second;
    altered[static_cast<std::size_t>(rng.index(static_cast<int>(altered.size())))] ^= 0x20;
    ground->receive(now, elsewhere, altered);
    robot->end->receive(now, kGround, altered);
    std::string noise(static_cast<std::size_t>(rng.index(1500)), '\0');
    for (char& byte : noise) byte = static_cast<char>(rng.index(256));
    ground->receive(now, elsewhere, noise);
    robot->end->receive(now, kGround, noise);
    ground->receive(now, elsewhere, stranger.seal("R1_LINK", std::string(40, 'x')).value());
  }
  run(1);
  EXPECT_TRUE(heard.empty());
  EXPECT_TRUE(robot->heard.empty());
  EXPECT_EQ(ground->counters().refused.unsealed, static_cast<long>(3 * count));
  EXPECT_EQ(ground->connected(), 1);
  EXPECT_EQ(robot->end->connected(), 1);
}

TEST_F(AnAttacker, DoesNotReachARobotFromElsewhere) {
  exchange::Sealer team_member(team, "BASE", "");
  const std::string genuine = team_member.seal("R1_LINK", std::string(16, 'x')).value();
  robot->end->receive(now, elsewhere, genuine);
  EXPECT_EQ(robot->end->counters().refused.strangers, 1);
}

TEST_F(AnAttacker, WhoHasAnotherRobotsFileIsNotTakenForThisOne) {
  exchange::Sealer r2(exchange::key_of(team, "R2").value(), "R2", "");
  std::string datagram = r2.seal("R2_LINK", std::string(16, 'x')).value();
  datagram.replace(2, 2, "R1");
  ground->receive(now, elsewhere, datagram);
  EXPECT_EQ(ground->counters().refused.unsealed, 1);
}

TEST_F(AnAttacker, WithTheFileOfALostRobotIsOutWhenItsKeyIsRenewed) {
  ++team.renewed["R1"];
  in_reach = false;
  start_ground();
  in_reach = true;
  run(5);
  EXPECT_EQ(ground->connected(), 0) << "the old file";
  Robot renewed(*this, "R1", 3, exchange::key_of(team, "R1").value());
  robots = {&renewed, &*robot};
  run(1);
  EXPECT_EQ(ground->connected(), 1);
  EXPECT_EQ(renewed.end->connected(), 1);
  EXPECT_EQ(robot->end->connected(), 0);
}

TEST_F(AnAttacker, TwoRobotsOfOneNameDoNotTakeTurns) {
  Robot second(*this, "R1", 3, exchange::key_of(team, "R1").value());
  robots.push_back(&second);
  for (int i = 0; i < 300; ++i) {
    say(*robot->bus, "R1_STATE", "first " + std::to_string(i));
    say(*second.bus, "R1_STATE", "second " + std::to_string(i));
    step();
  }
  EXPECT_TRUE(on(heard, "R1_STATE").size() > 3);
  for (const std::string& text : on(heard, "R1_STATE")) EXPECT_EQ(text.substr(0, 5), "first");
  EXPECT_GT(ground->counters().refused.second, 0);
  robots = {&second};  // the first one is off
  run(5);
  say(*second.bus, "R1_STATE", "second");
  run(1);
  EXPECT_EQ(on(heard, "R1_STATE").back(), "second");
}

TEST_F(AnAttacker, MoreRobotsThanTheCeilingAreRefused) {
  for (int i = 0; i < 6; ++i) {
    const std::string name = fmt::format("X{}", i);
    exchange::Sealer sealer(team, name, "");
    ground->receive(now, elsewhere, sealer.seal(name + "_LINK", std::string(16, 'x')).value());
  }
  EXPECT_EQ(ground->counters().refused.crowded, 3);
  EXPECT_EQ(ground->connected(), 1);
}

}  // namespace
}  // namespace saker::flight
