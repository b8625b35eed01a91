#include <gtest/gtest.h>

#include "flight/base_station/relay.h"
#include "saker/core/error.h"

namespace saker::flight {
namespace {

using std::chrono::milliseconds;
using Bytes = std::vector<std::uint8_t>;
using Steady = Relay::Steady;

/// Two networks without sockets with a relay between them; a seal is the byte 7 in front.
class BetweenTwoNetworks : public testing::Test {
 protected:
  static std::optional<Bytes> open(const std::string&, Bus::Bytes sealed) {
    if (sealed.empty() || sealed[0] != 7) return std::nullopt;
    return Bytes(sealed.begin() + 1, sealed.end());
  }

  static RelayConfig config() {
    RelayConfig result;
    result.up = {{"_STATE", 10}, {"_COMMAND_ACK", 10}};
    result.down = {{"_COMMAND", 10}};
    result.most_channels = 3;
    result.most_message_kb = 1;
    return result;
  }

  /// Notes what arrives on `bus`.
  static std::vector<std::pair<std::string, Bytes>>& listen(
      Bus& bus, std::vector<std::pair<std::string, Bytes>>& heard) {
    for (const char* suffix : {"_STATE", "_COMMAND", "_COMMAND_ACK", "_ODOMETRY"}) {
      bus.subscribe_raw(suffix, [&heard](const std::string& channel, Bus::Bytes bytes) {
        heard.emplace_back(channel, Bytes(bytes.begin(), bytes.end()));
        return true;
      });
    }
    return heard;
  }

  void pass(Steady::time_point at) {
    Bus::handle({&robots, &ground}, milliseconds(0));
    relay.step(at);
    Bus::handle({&robots, &ground}, milliseconds(0));
  }

  Steady::time_point after_ms(int ms) const { return begin + milliseconds(ms); }

  Bus robots = Bus::in_memory("BASE"), ground = Bus::in_memory("BASE");
  Relay relay{config(), robots, ground, open};
  std::vector<std::pair<std::string, Bytes>> of_robots, of_ground;
  const Steady::time_point begin = Steady::now();
};

TEST_F(BetweenTwoNetworks, TelemetryGoesUpByteForByteOnTheSameChannel) {
  listen(ground, of_ground);
  const Bytes junk = {0, 255, 1, 2, 0};
  robots.publish_raw("R1_STATE", junk);
  robots.publish_raw("DRONE7_COMMAND_ACK", Bytes{9});
  pass(begin);
  ASSERT_EQ(of_ground.size(), 2u);
  EXPECT_EQ(of_ground[1].first, "R1_STATE");
  EXPECT_EQ(of_ground[1].second, junk);
  EXPECT_EQ(of_ground[0].first, "DRONE7_COMMAND_ACK");
  EXPECT_EQ(relay.counters().up.messages, 2);
  EXPECT_EQ(relay.counters().up.bytes, 6);
}

TEST_F(BetweenTwoNetworks, WhatIsNotNamedStaysWhereItIs) {
  listen(ground, of_ground);
  robots.publish_raw("R1_ODOMETRY", Bytes{1});
  robots.publish_raw("R1_COMMAND", Bytes{7, 1});
  robots.publish_raw("r1_STATE", Bytes{1});
  pass(begin);
  EXPECT_TRUE(of_ground.empty());
}

TEST_F(BetweenTwoNetworks, ACommandGoesDownOpenedWhenItIsSealed) {
  listen(robots, of_robots);
  ground.publish_raw("R1_COMMAND", Bytes{7, 42});
  pass(begin);
  ASSERT_EQ(of_robots.size(), 1u);
  EXPECT_EQ(of_robots[0].first, "R1_COMMAND");
  EXPECT_EQ(of_robots[0].second, Bytes{42});
}

TEST_F(BetweenTwoNetworks, ACommandWithoutTheSealIsDroppedAndCounted) {
  listen(robots, of_robots);
  ground.publish_raw("R1_COMMAND", Bytes{42});
  pass(begin);
  EXPECT_TRUE(of_robots.empty());
  EXPECT_EQ(relay.counters().not_ours, 1);
  EXPECT_EQ(relay.counters().down.messages, 0);
}

TEST_F(BetweenTwoNetworks, TelemetryDoesNotComeDown) {
  listen(robots, of_robots);
  ground.publish_raw("R1_STATE", Bytes{7, 1});
  pass(begin);
  EXPECT_TRUE(of_robots.empty());
}

TEST_F(BetweenTwoNetworks, OfWhatComesFasterThanTheRateTheNewestPasses) {
  listen(ground, of_ground);
  for (std::uint8_t i = 0; i < 100; ++i) {  // 100 Hz for a second
    robots.publish_raw("R1_STATE", Bytes{i});
    pass(after_ms(10 * i));
  }
  pass(after_ms(1000));
  ASSERT_EQ(of_ground.size(), 11u);
  for (std::size_t k = 1; k < of_ground.size(); ++k) {
    EXPECT_EQ(of_ground[k].second[0], std::min<std::size_t>(10 * k, 99));
  }
  EXPECT_EQ(relay.counters().replaced, 100 - 11);
}

TEST_F(BetweenTwoNetworks, EachRobotHasItsOwnRate) {
  listen(ground, of_ground);
  robots.publish_raw("R1_STATE", Bytes{1});
  robots.publish_raw("R2_STATE", Bytes{2});
  pass(begin);
  EXPECT_EQ(of_ground.size(), 2u);
}

TEST_F(BetweenTwoNetworks, ItWaitsUntilTheRateAllowsTheNextAndNoLonger) {
  robots.publish_raw("R1_STATE", Bytes{1});
  pass(begin);
  EXPECT_EQ(relay.next_due(), Steady::time_point::max());
  robots.publish_raw("R1_STATE", Bytes{2});
  pass(after_ms(10));
  EXPECT_EQ(relay.next_due(), after_ms(100));
}

TEST_F(BetweenTwoNetworks, WhatASecondRelayCarriesBackDoesNotGoRound) {
  ground.subscribe_raw("_STATE", [this](const std::string& channel, Bus::Bytes bytes) {
    of_ground.emplace_back(channel, Bytes(bytes.begin(), bytes.end()));
    return robots.publish_raw(channel, bytes);  // the second relay, down
  });
  robots.publish_raw("R1_STATE", Bytes{1, 2, 3});
  for (int ms = 0; ms < 900; ms += 20) pass(after_ms(ms));
  EXPECT_EQ(of_ground.size(), 1u);
  EXPECT_EQ(relay.counters().echoes, 1);
}

TEST_F(BetweenTwoNetworks, AnEchoDoesNotReplaceWhatIsNew) {
  listen(ground, of_ground);
  robots.publish_raw("R1_STATE", Bytes{1});
  pass(begin);
  robots.publish_raw("R1_STATE", Bytes{2});
  robots.publish_raw("R1_STATE", Bytes{1});
  pass(after_ms(10));
  pass(after_ms(100));
  ASSERT_EQ(of_ground.size(), 2u);
  EXPECT_EQ(of_ground[1].second, Bytes{2});
}

TEST_F(BetweenTwoNetworks, TheSameBytesSaidAnewLaterPass) {
  listen(ground, of_ground);
  robots.publish_raw("R1_STATE", Bytes{1});
  pass(begin);
  pass(after_ms(1500));
  robots.publish_raw("R1_STATE", Bytes{1});
  pass(after_ms(1510));
  EXPECT_EQ(of_ground.size(), 2u);
}

TEST_F(BetweenTwoNetworks, WhatIsTooLargeOrOfTooManyChannelsIsDroppedAndCounted) {
  listen(ground, of_ground);
  robots.publish_raw("R1_STATE", Bytes(1025));
  for (const char* robot : {"R1", "R2", "R3", "R4", "R5"})
    robots.publish_raw(std::string(robot) + "_STATE", Bytes(1024));
  pass(begin);
  EXPECT_EQ(relay.counters().oversized, 1);
  EXPECT_EQ(relay.counters().crowded, 2);
  EXPECT_EQ(of_ground.size(), 3u);
}

TEST_F(BetweenTwoNetworks, TheBasesOwnChannelsArePublishedNotRelayed) {
  listen(ground, of_ground);
  robots.publish_raw("BASE_STATE", Bytes{1});
  pass(begin);
  EXPECT_TRUE(of_ground.empty());
}

std::string refusal(const RelayConfig& config) {
  Bus robots = Bus::in_memory("BASE"), ground = Bus::in_memory("BASE");
  try {
    Relay(config, robots, ground, [](const std::string&, Bus::Bytes) { return std::nullopt; });
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(RelayConfiguration, AChannelInBothDirectionsIsRefused) {
  RelayConfig config;
  config.down.push_back({"_STATE", 1});
  EXPECT_EQ(refusal(config),
            "base.relay: channel _STATE is named twice, expected once: it passes in one direction");
}

TEST(RelayConfiguration, ChannelsOfOneNetworkAreRefused) {
  for (const char* channel : {"_EXCHANGE", "_PRESENCE"}) {
    RelayConfig config;
    config.up.push_back({channel, 1});
    EXPECT_NE(refusal(config).find(channel), std::string::npos);
  }
}

TEST(RelayConfiguration, WhatIsNoChannelIsRefused) {
  for (const char* channel : {"", "STATE", "_.*", "_state", "R1_STATE"}) {
    RelayConfig config;
    config.up.push_back({channel, 1});
    EXPECT_NE(refusal(config).find("expected the end of a name"), std::string::npos) << channel;
  }
}

TEST(RelayConfiguration, TheDefaultsAreGood) { EXPECT_EQ(refusal(RelayConfig{}), ""); }

}  // namespace
}  // namespace saker::flight
