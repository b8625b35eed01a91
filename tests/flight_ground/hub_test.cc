#include "flight/ground/hub.h"

#include <gtest/gtest.h>

namespace saker::flight::ground {
namespace {

const Hub::Steady::time_point kNow = Hub::Steady::now();

/// A client of the hub, without a socket.
struct Client {
  explicit Client(Hub& h, bool sdk = false) : hub(h), id(h.open("10.0.0.7", sdk, kNow)) {}

  bool say(const std::string& message) {
    return hub.hear(id, {reinterpret_cast<const std::uint8_t*>(message.data()), message.size()},
                    false, kNow);
  }
  bool subscribe(std::uint32_t own, std::uint64_t channel) {
    return say(
        Json({{"op", "subscribe"}, {"subscriptions", {{{"id", own}, {"channelId", channel}}}}})
            .dump());
  }
  void call(std::uint32_t service, const std::string& payload) {
    std::string message = service_response(service, 5, payload);  // a request has the same bytes
    message[0] = 2;
    EXPECT_TRUE(hub.hear(
        id, {reinterpret_cast<const std::uint8_t*>(message.data()), message.size()}, true, kNow));
  }
  /// Everything that waits: JSON of texts, payloads of messages, answers of services.
  std::vector<std::string> take_all() {
    std::vector<std::string> all;
    while (const auto next = hub.take(id, kNow)) all.push_back(*next->body);
    return all;
  }

  Hub& hub;
  Hub::SessionId id;
};

struct HubTest : ::testing::Test {
  Hub hub{{.mode = "live", .version = "1", .session = "s", .begin = {}, .end = {}}};
  std::uint64_t newest = hub.add_channel("/R1/state", "saker.State", "{}", 5, false);
  std::uint64_t events = hub.add_channel("/R1/log", "foxglove.Log", "{}", 5, true);
};

TEST_F(HubTest, GreetsWithWhatThereIs) {
  Client client(hub);
  const auto said = client.take_all();
  ASSERT_EQ(said.size(), 3u);
  EXPECT_EQ(Json::parse(said[0])["op"], "serverInfo");
  EXPECT_EQ(Json::parse(said[1])["channels"].size(), 2u);
  EXPECT_EQ(Json::parse(said[2])["services"][0]["name"], "history");
}

TEST_F(HubTest, ASubscriptionBeginsWithTheNewestOrWithAllThatIsKept) {
  for (int i = 0; i < 9; ++i) {
    hub.publish(newest, i, std::to_string(i));
    hub.publish(events, i, std::to_string(i));
  }
  Client client(hub);
  client.take_all();
  client.subscribe(1, newest);
  EXPECT_EQ(client.take_all(), std::vector<std::string>{"8"});
  client.subscribe(2, events);
  EXPECT_EQ(client.take_all(), (std::vector<std::string>{"4", "5", "6", "7", "8"}));
  hub.publish(newest, 9, "9");
  EXPECT_EQ(client.take_all(), std::vector<std::string>{"9"});
}

TEST_F(HubTest, AChannelIsWantedWhileSomebodyIsSubscribed) {
  EXPECT_FALSE(hub.wanted(newest));
  Client a(hub), b(hub);
  a.subscribe(1, newest);
  b.subscribe(1, newest);
  a.say(R"({"op":"unsubscribe","subscriptionIds":[1]})");
  EXPECT_TRUE(hub.wanted(newest));
  hub.close(b.id);
  EXPECT_FALSE(hub.wanted(newest));
}

TEST_F(HubTest, ANewChannelIsMadeKnownToThoseWhoAreThere) {
  Client client(hub);
  client.take_all();
  hub.add_channel("/R2/state", "saker.State", "{}", 1, false);
  const auto said = client.take_all();
  ASSERT_EQ(said.size(), 1u);
  EXPECT_EQ(Json::parse(said[0])["channels"][0]["topic"], "/R2/state");
}

TEST_F(HubTest, GarbageCutsItsSenderAndNobodyElse) {
  Client good(hub), bad(hub);
  good.subscribe(1, newest);
  good.take_all();
  EXPECT_FALSE(bad.say("garbage"));
  hub.close(bad.id);
  EXPECT_EQ(hub.counters().garbage, 1);
  hub.publish(newest, 1, "1");
  EXPECT_EQ(good.take_all(), std::vector<std::string>{"1"});
}

TEST_F(HubTest, WhatIsNotThereIsSaidToBeSo) {
  Client client(hub);
  client.take_all();
  EXPECT_TRUE(client.subscribe(1, 77));
  EXPECT_EQ(Json::parse(client.take_all().at(0))["level"], 2);
  EXPECT_TRUE(client.say(R"({"op":"fetchAsset","uri":"x","requestId":1})"));
  EXPECT_EQ(Json::parse(client.take_all().at(0))["op"], "status");
}

TEST_F(HubTest, HistoryIsWhatIsKeptOfTheLastSeconds) {
  for (int i = 0; i < 9; ++i) hub.publish(newest, i * kNanosecondsPerSecond, std::to_string(i));
  Client client(hub);
  client.take_all();
  client.call(1, R"({"topic":"/R1/state","seconds":2})");
  const std::string answer = client.take_all().at(0);
  const Json json = Json::parse(answer.substr(answer.find('{')));
  ASSERT_EQ(json["messages"].size(), 3u);
  EXPECT_EQ(json["messages"][0]["t_s"], 6);
  EXPECT_EQ(json["messages"][2]["message"], 8);
}

TEST_F(HubTest, AWrongCallFailsWithALine) {
  Client client(hub);
  client.take_all();
  for (const char* payload : {"x", "[]", "{}", R"({"topic":"/none","seconds":1})",
                              R"({"topic":"/R1/state","seconds":"1"})"}) {
    client.call(1, payload);
    const Json failure = Json::parse(client.take_all().at(0));
    EXPECT_EQ(failure["op"], "serviceCallFailure") << payload;
    EXPECT_EQ(failure["callId"], 5);
  }
  client.call(9, "{}");
  EXPECT_EQ(Json::parse(client.take_all().at(0))["message"], "no such service");
}

TEST_F(HubTest, AnAnswerMayComeLaterAndToNobody) {
  Hub::Reply later;
  hub.add_service("slow", "{}", "{}", [&](const Json&, const std::string& from, Hub::Reply reply) {
    EXPECT_EQ(from, "10.0.0.7");
    later = std::move(reply);
  });
  Client client(hub);
  client.take_all();
  client.call(2, "{}");
  EXPECT_TRUE(client.take_all().empty());
  later({true, R"({"x":1})"});
  EXPECT_EQ(client.take_all().size(), 1u);
  client.call(2, "{}");
  hub.close(client.id);
  later({true, "{}"});  // nothing happens
  EXPECT_EQ(hub.sessions(), 0u);
}

TEST_F(HubTest, KeptMessagesAreBoundedInBytes) {
  const std::uint64_t large = hub.add_channel("/R1/objects", "saker.Objects", "{}", 240, false);
  for (int i = 0; i < 20; ++i) hub.publish(large, i, '"' + std::string(1000000, 'x') + '"');
  Client client(hub);
  client.take_all();
  client.call(1, R"({"topic":"/R1/objects","seconds":1000})");
  EXPECT_LT(client.take_all().at(0).size(), 5000000u);
}

TEST_F(HubTest, PlaybackIsToldToThoseWhoKnowIt) {
  Client v1(hub), sdk(hub, true);
  v1.take_all();
  sdk.take_all();
  hub.tell_playback(PlaybackStatus::paused, 1, 1, false, "r");
  EXPECT_TRUE(v1.take_all().empty());
  EXPECT_EQ(sdk.take_all().size(), 1u);
}

}  // namespace
}  // namespace saker::flight::ground
