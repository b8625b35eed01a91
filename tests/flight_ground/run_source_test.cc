#include "flight/ground/run_source.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace saker::flight::ground
