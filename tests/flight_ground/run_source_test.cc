#include "flight/ground/run_source.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>

#include "flight/bus/scan_messages.h"
#include "flight_viewers/made_robot.h"

namespace saker::flight::ground {
namespace {

using namespace viewers::testing;
using viewers::RobotViews;

/// 10 s in which the robot flies 1 m/s, from 100 s of its clock on.
struct MadeRun : viewers::Run {
  [[nodiscard]] double begin_s() const override { return 100; }
  [[nodiscard]] double end_s() const override { return 110; }
  void advance(double t, RobotViews& views) override {
    const auto utime = static_cast<std::int64_t>((t - 100) * 1e6) + 1;
    views.of("R1")->hear(made_odometry(utime, t - 100, 0), t);
  }
  void rewind(RobotViews& views) override {
    views.clear();
    ++rewinds;
  }
  int rewinds = 0;
};

struct RunSourceTest : ::testing::Test {
  RunSourceTest() {
    source.offer();
    client = hub.open("", true, now);
    take();
    subscribe("/R1/odometry", 1);
  }

  void subscribe(const std::string& topic, int own) {
    Json asked = {{"op", "subscribe"}};
    for (int channel = 0; channel < viewers::kTopics; ++channel) {
      // Channels are told in order: the first is /playback, then a robot's topics in theirs.
      if (topic == viewers::topic_name("R1", static_cast<viewers::Topic>(channel)))
        asked["subscriptions"] = {{{"id", own}, {"channelId", channel + 2}}};
    }
    const std::string text = asked.dump();
    static_cast<void>(hub.hear(
        client, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, false, now));
  }
  void call(std::uint32_t service, const std::string& payload) {
    std::string message = service_response(service, 1, payload);
    message[0] = 2;
    static_cast<void>(
        hub.hear(client, {reinterpret_cast<const std::uint8_t*>(message.data()), message.size()},
                 true, now));
  }
  std::vector<std::string> take() {
    std::vector<std::string> all;
    while (const auto next = hub.take(client, now)) all.push_back(*next->body);
    return all;
  }
  /// x of the newest odometry that was sent.
  double newest_x() {
    double x = NAN;
    for (const std::string& message : take()) {
      const Json json = Json::parse(message, nullptr, false);
      if (json.is_object() && json.contains("position")) x = json["position"][0];
    }
    return x;
  }

  Hub::Steady::time_point now = Hub::Steady::now();
  MadeRun run;
  Hub hub{{.mode = "run", .version = "1", .session = "s", .begin = 0, .end = 1}};
  RunSource source{run, *made_site(), hub};
  Hub::SessionId client = 0;
};

constexpr std::uint32_t kPlay = 2, kSeek = 3;  // after `history`

TEST_F(RunSourceTest, StandsAtItsEndWhereAllOfItIsShown) {
  EXPECT_EQ(source.state().t_s, 110);
  EXPECT_FALSE(source.state().playing);
  EXPECT_NEAR(newest_x(), 10, 1e-6);
}

TEST_F(RunSourceTest, AfterASeekEveryTopicSaysItsStateOfThen) {
  take();
  call(kSeek, R"({"t_s": 103})");
  source.step(0.05);
  EXPECT_EQ(run.rewinds, 1);
  EXPECT_EQ(source.state().t_s, 103);
  EXPECT_NEAR(newest_x(), 3, 1e-6);
  call(kSeek, R"({"t_s": 1e9})");
  source.step(0.05);
  EXPECT_EQ(source.state().t_s, 110);
  EXPECT_EQ(run.rewinds, 1);  // ahead it plays on
}

TEST_F(RunSourceTest, PlaysAtItsSpeedToItsEnd) {
  call(kSeek, R"({"t_s": 100})");
  call(kPlay, R"({"playing": true, "speed": 4})");
  source.step(0.05);
  source.step(1);
  EXPECT_NEAR(source.state().t_s, 104.2, 1e-6);
  EXPECT_NEAR(newest_x(), 4.2, 1e-6);
  source.step(10);
  EXPECT_EQ(source.state().t_s, 110);
  EXPECT_FALSE(source.state().playing);
}

TEST_F(RunSourceTest, FromItsEndItPlaysFromItsBeginning) {
  call(kPlay, R"({"playing": true})");
  source.step(0);
  EXPECT_EQ(source.state().t_s, 100);
  EXPECT_TRUE(source.state().playing);
}

TEST_F(RunSourceTest, AnswersWhereItIs) {
  take();
  call(kPlay, R"({"playing": true, "speed": 1e9})");
  source.step(0);
  bool answered = false;
  for (const std::string& said : take()) {
    const std::size_t at = said.find(R"({"playing")");
    if (at == std::string::npos || said.find("json{") == std::string::npos) continue;
    const Json json = Json::parse(said.substr(at));
    EXPECT_EQ(json["speed"], 100);  // at most
    EXPECT_EQ(json["begin_s"], 100);
    answered = true;
  }
  EXPECT_TRUE(answered);
  call(kPlay, R"({"playing": 1})");
  EXPECT_NE(take().at(0).find("serviceCallFailure"), std::string::npos);
  call(kSeek, R"({"t_s": "x"})");
  EXPECT_NE(take().at(0).find("serviceCallFailure"), std::string::npos);
}

bool has(const std::vector<std::string>& said, const std::string& what) {
  return std::ranges::find(said, what) != said.end();
}

/// Playback control of the protocol, as the SDK's clients send it.
std::string control(bool playing, float speed, std::optional<std::uint64_t> seek,
                    const std::string& request) {
  std::string message = {'\3', playing ? '\0' : '\1'};
  const auto add = [&](std::uint64_t value, int size) {
    for (int i = 0; i < size; ++i) message += static_cast<char>(value >> (8 * i) & 0xff);
  };
  add(std::bit_cast<std::uint32_t>(speed), 4);
  add(seek ? 1 : 0, 1);
  add(seek.value_or(0), 8);
  add(request.size(), 4);
  return message + request;
}

TEST_F(RunSourceTest, ThePlaybackControlOfTheProtocolSeeksAndPlays) {
  const std::string message = control(true, 2, 104500000000, "id-7");
  EXPECT_TRUE(hub.hear(
      client, {reinterpret_cast<const std::uint8_t*>(message.data()), message.size()}, true, now));
  take();
  source.step(0);
  EXPECT_EQ(source.state().t_s, 104.5);
  EXPECT_TRUE(source.state().playing);
  EXPECT_EQ(source.state().speed, 2);
  EXPECT_TRUE(has(take(), playback_state(PlaybackStatus::playing, 104500000000, 2, true, "id-7")));
}

TEST_F(RunSourceTest, ItsEndIsToldOnce) {
  call(kSeek, R"({"t_s": 109})");
  call(kPlay, R"({"playing": true})");
  source.step(0);
  take();
  source.step(5);
  const std::string ended = playback_state(PlaybackStatus::ended, 110000000000, 1, false, "");
  EXPECT_TRUE(has(take(), ended));
  source.step(5);
  EXPECT_FALSE(has(take(), ended));
}

TEST_F(RunSourceTest, PausedItStays) {
  call(kSeek, R"({"t_s": 103})");
  call(kPlay, R"({"playing": false})");
  source.step(0);
  for (int i = 0; i < 10; ++i) source.step(1);
  EXPECT_EQ(source.state().t_s, 103);
}

TEST_F(RunSourceTest, ASeekStaysWithinTheRun) {
  call(kSeek, R"({"t_s": -1e300})");
  source.step(0);
  EXPECT_EQ(source.state().t_s, 100);
  call(kSeek, R"({"t_s": 1e300})");
  source.step(0);
  EXPECT_EQ(source.state().t_s, 110);
}

TEST_F(RunSourceTest, ASpeedIsATenthToAHundred) {
  for (const auto& [asked, given] :
       {std::pair{"0", 0.1}, {"-5", 0.1}, {"7", 7.0}, {"1e300", 100.0}}) {
    call(kPlay, std::string(R"({"playing": false, "speed": )") + asked + "}");
    source.step(0);
    EXPECT_DOUBLE_EQ(source.state().speed, given) << asked;
  }
}

TEST_F(RunSourceTest, ASeekWhilePlayingPlaysOnFromThere) {
  call(kPlay, R"({"playing": true, "speed": 1})");
  source.step(1);
  call(kSeek, R"({"t_s": 107})");
  source.step(0);
  source.step(1);
  EXPECT_TRUE(source.state().playing);
  EXPECT_NEAR(source.state().t_s, 108, 1e-9);
}

TEST_F(RunSourceTest, MoreThanCanBeDoneAtOnceIsRefused) {
  take();
  for (int i = 0; i < 70; ++i) call(kSeek, R"({"t_s": 103})");
  const auto refused = take();
  EXPECT_EQ(refused.size(), 6u);
  EXPECT_NE(refused.at(0).find("too much was asked at once"), std::string::npos);
  source.step(0);
  call(kSeek, R"({"t_s": 104})");
  source.step(0);
  EXPECT_EQ(source.state().t_s, 104);
}

TEST_F(RunSourceTest, HistoryAfterAJumpHoldsNothingOfBefore) {
  call(kSeek, R"({"t_s": 103})");
  source.step(0);
  take();
  call(1, R"({"topic": "/R1/odometry", "seconds": 1000})");
  const std::string answer = take().at(0);
  const Json messages = Json::parse(answer.substr(answer.find('{')))["messages"];
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_EQ(messages[0]["t_s"], 103);
}

TEST_F(RunSourceTest, SaysWhereItIsFiveTimesASecond) {
  call(kSeek, R"({"t_s": 100})");
  call(kPlay, R"({"playing": true})");
  source.step(0);
  take();
  int said = 0;
  for (int i = 0; i < 40; ++i) {  // 2 s
    source.step(0.05);
    for (const std::string& message : take())
      said += message == time_message(viewers_time(source.state().t_s)) ? 1 : 0;
  }
  EXPECT_GE(said, 8);
  EXPECT_LE(said, 11);
}

/// A scan each second, as a log has it.
struct ScanRun : MadeRun {
  void advance(double t, RobotViews& views) override {
    MadeRun::advance(t, views);
    autonomy::RegisteredScan scan = made_scan(50);
    scan.stamp = from_seconds(t);
    for (const scan_t& chunk : to_lcm(scan, static_cast<int>(t))) {
      std::vector<std::uint8_t> bytes(static_cast<std::size_t>(chunk.getEncodedSize()));
      chunk.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
      EXPECT_TRUE(views.hear("R1_SCAN", bytes, t));
    }
  }
};

TEST(RunSourceScans, ALogsPointsAreShownToThoseWhoWantThem) {
  ScanRun run;
  Hub hub{{.mode = "run", .version = "1", .session = "s", .begin = 0, .end = 1}};
  RunSource source(run, *made_site(), hub);
  source.offer();
  const auto now = Hub::Steady::now();
  const Hub::SessionId client = hub.open("", false, now);
  const auto points = static_cast<std::uint64_t>(viewers::Topic::points);
  std::uint64_t channel = 0;
  while (const auto next = hub.take(client, now)) {
    const Json json = Json::parse(*next->body, nullptr, false);
    if (!json.is_object() || !json.contains("channels")) continue;
    for (const Json& c : json["channels"]) {
      if (c["topic"] == viewers::topic_name("R1", static_cast<viewers::Topic>(points)))
        channel = c["id"];
    }
  }
  ASSERT_NE(channel, 0u);
  const std::string asked =
      Json({{"op", "subscribe"}, {"subscriptions", {{{"id", 1}, {"channelId", channel}}}}}).dump();
  EXPECT_TRUE(hub.hear(client, {reinterpret_cast<const std::uint8_t*>(asked.data()), asked.size()},
                       false, now));
  std::string seek = service_response(kSeek, 1, R"({"t_s": 105})");
  seek[0] = 2;
  EXPECT_TRUE(hub.hear(client, {reinterpret_cast<const std::uint8_t*>(seek.data()), seek.size()},
                       true, now));
  source.step(0);
  bool shown = false;
  while (const auto next = hub.take(client, now))
    shown |= next->body->find("point_stride") != std::string::npos;
  EXPECT_TRUE(shown);
}

}  // namespace
}  // namespace saker::flight::ground
