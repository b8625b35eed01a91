#include "flight/ground/hub.h"

#include <gtest/gtest.h>

#include <atomic>
#include <set>
#include <thread>

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

TEST_F(HubTest, OneThatAsksAndNeverTakesIsCutBeforeItHoldsMuch) {
  hub.publish(newest, 1, '"' + std::string(4000000, 'x') + '"');
  Client greedy(hub);
  std::string message = service_response(1, 5, R"({"topic":"/R1/state","seconds":1})");
  message[0] = 2;
  int answered = 0;
  while (answered < 1000 &&
         hub.hear(greedy.id,
                  {reinterpret_cast<const std::uint8_t*>(message.data()), message.size()}, true,
                  kNow))
    ++answered;
  EXPECT_LE(answered, 5);  // of 4 MB each, where 16 MB may wait
  EXPECT_GE(answered, 4);
}

TEST_F(HubTest, OneThatIsCutIsCountedOnceHoweverLongItTakes) {
  Hub small({.mode = "live", .version = "1", .session = "s", .begin = {}, .end = {}},
            {.most_answer_bytes = 10});
  Client client(small);  // its greeting is more than that
  EXPECT_FALSE(client.say(R"({"op":"unsubscribe","subscriptionIds":[]})"));
  EXPECT_EQ(small.stuck(kNow), std::vector<Hub::SessionId>{client.id});
  EXPECT_EQ(small.stuck(kNow).size(), 1u);
  EXPECT_EQ(small.counters().stuck, 1);
  small.close(client.id);
  EXPECT_TRUE(small.stuck(kNow).empty());
  EXPECT_EQ(small.counters().stuck, 1);
  EXPECT_EQ(small.counters().garbage, 0);
}

TEST_F(HubTest, OneThatTakesNothingForLongIsStuckOthersAreNot) {
  Client slow(hub), quick(hub);
  quick.take_all();
  EXPECT_TRUE(hub.stuck(kNow + std::chrono::seconds(9)).empty());
  EXPECT_EQ(hub.stuck(kNow + std::chrono::seconds(11)), std::vector<Hub::SessionId>{slow.id});
}

TEST_F(HubTest, WhoIsGoneIsNotHeard) {
  Client client(hub);
  hub.close(client.id);
  EXPECT_FALSE(client.say(R"({"op":"unsubscribe","subscriptionIds":[]})"));
  EXPECT_TRUE(client.take_all().empty());
  hub.close(client.id);  // twice is once
  EXPECT_EQ(hub.counters().closed, 1);
}

TEST_F(HubTest, NoSessionsIdIsUsedAgain) {
  std::set<Hub::SessionId> ids;
  for (int i = 0; i < 5; ++i) {
    Client client(hub);
    EXPECT_TRUE(ids.insert(client.id).second);
    hub.close(client.id);
  }
  EXPECT_EQ(hub.counters().opened, 5);
}

TEST_F(HubTest, UnsubscribingFromWhatIsNotSubscribedToDoesNothing) {
  Client a(hub), b(hub);
  a.subscribe(1, newest);
  EXPECT_TRUE(b.say(R"({"op":"unsubscribe","subscriptionIds":[1,2,3]})"));
  EXPECT_TRUE(a.say(R"({"op":"unsubscribe","subscriptionIds":[7]})"));
  EXPECT_TRUE(hub.wanted(newest));
  EXPECT_TRUE(a.say(R"({"op":"unsubscribe","subscriptionIds":[1,1]})"));
  EXPECT_FALSE(hub.wanted(newest));
}

TEST_F(HubTest, ASecondSubscriptionToAChannelIsRefusedAndCountsNot) {
  Client client(hub);
  client.subscribe(1, newest);
  client.take_all();
  client.subscribe(2, newest);
  EXPECT_EQ(Json::parse(client.take_all().at(0))["level"], 2);
  hub.close(client.id);
  EXPECT_FALSE(hub.wanted(newest));
}

TEST_F(HubTest, WhatWasKeptIsForgottenAfterAJump) {
  hub.publish(newest, 1, "1");
  hub.publish(events, 1, "1");
  hub.forget();
  Client client(hub);
  client.take_all();
  client.subscribe(1, newest);
  client.subscribe(2, events);
  EXPECT_TRUE(client.take_all().empty());
}

TEST_F(HubTest, TheTimeOfARunIsToldToAllTheNewestAlone) {
  Client early(hub);
  early.subscribe(1, newest);
  early.take_all();
  hub.publish(newest, 5, "5");  // what waits keeps no time back
  hub.tell_time(5);
  hub.tell_time(6);
  EXPECT_EQ(early.take_all(), (std::vector<std::string>{time_message(6), "5"}));
  Client late(hub);
  EXPECT_EQ(late.take_all().back(), time_message(6));
}

TEST_F(HubTest, HistoryNeverHasMoreThan240Messages) {
  const std::uint64_t long_one = hub.add_channel("/R1/long", "s", "{}", 1000, false);
  for (int i = 0; i < 1000; ++i) hub.publish(long_one, i, std::to_string(i));
  Client client(hub);
  client.take_all();
  client.call(1, R"({"topic":"/R1/long","seconds":1e300})");
  const std::string answer = client.take_all().at(0);
  const Json messages = Json::parse(answer.substr(answer.find('{')))["messages"];
  ASSERT_EQ(messages.size(), 240u);
  EXPECT_EQ(messages.back()["message"], 999);
}

TEST_F(HubTest, HistoryOfNoSecondsIsTheNewestMessage) {
  for (int i = 0; i < 3; ++i) hub.publish(newest, i * kNanosecondsPerSecond, std::to_string(i));
  Client client(hub);
  client.take_all();
  for (const char* seconds : {"0", "-1", "-1e300"}) {
    client.call(1, std::string(R"({"topic":"/R1/state","seconds":)") + seconds + "}");
    const std::string answer = client.take_all().at(0);
    EXPECT_EQ(Json::parse(answer.substr(answer.find('{')))["messages"].size(), 1u) << seconds;
  }
}

TEST_F(HubTest, HistoryOfWhatSaidNothingYetIsEmpty) {
  Client client(hub);
  client.take_all();
  client.call(1, R"({"topic":"/R1/state","seconds":60})");
  const std::string answer = client.take_all().at(0);
  EXPECT_EQ(Json::parse(answer.substr(answer.find('{'))),
            Json::parse(R"({"topic":"/R1/state","messages":[]})"));
}

TEST_F(HubTest, ACallInAnotherEncodingFails) {
  Client client(hub);
  client.take_all();
  const std::string call("\2\1\0\0\0\5\0\0\0\4\0\0\0cbor\xa0", 18);
  EXPECT_TRUE(hub.hear(client.id, {reinterpret_cast<const std::uint8_t*>(call.data()), call.size()},
                       true, kNow));
  EXPECT_EQ(Json::parse(client.take_all().at(0))["message"], "expected the encoding json");
}

TEST_F(HubTest, PayloadsOfNoUtf8AreNoJson) {
  Client client(hub);
  client.take_all();
  client.call(1, "{\"topic\":\"/\xff\xfe\",\"seconds\":1}");
  EXPECT_EQ(Json::parse(client.take_all().at(0))["op"], "serviceCallFailure");
}

TEST_F(HubTest, WhatClientsMissedIsCountedWhenTheyAreGone) {
  Hub small({.mode = "live", .version = "1", .session = "s", .begin = {}, .end = {}},
            {.most_messages = 2});
  const std::uint64_t channel = small.add_channel("/R1/a", "s", "{}", 1, false);
  Client client(small);
  client.subscribe(1, channel);
  for (int i = 0; i < 5; ++i) small.publish(channel, i, "1");
  EXPECT_EQ(small.counters().dropped, 3);
  small.close(client.id);
  EXPECT_EQ(small.counters().dropped, 3);
}

TEST_F(HubTest, TheServerIsWokenWhereThereIsSomethingToSend) {
  int woken = 0;
  hub.on_output([&] { ++woken; });
  hub.publish(newest, 1, "1");
  EXPECT_EQ(woken, 0);  // nobody wants it
  Client client(hub);
  client.subscribe(1, newest);
  EXPECT_EQ(hub.with_output(), std::vector<Hub::SessionId>{client.id});
  client.take_all();
  EXPECT_TRUE(hub.with_output().empty());
  hub.publish(newest, 2, "2");
  EXPECT_EQ(woken, 1);
  EXPECT_EQ(hub.with_output().size(), 1u);
}

TEST_F(HubTest, ClientsComeAndGoWhileTheSourcePublishes) {
  std::atomic<bool> over = false;
  std::thread source([&] {
    for (int i = 0; !over; ++i) {
      hub.publish(newest, i, std::to_string(i));
      std::this_thread::sleep_for(std::chrono::microseconds(10));
    }
  });
  for (int i = 0; i < 200; ++i) {
    Client client(hub);
    client.subscribe(1, newest);
    for (int k = 0; k < 20; ++k) static_cast<void>(hub.take(client.id, kNow));
    hub.close(client.id);
  }
  over = true;
  source.join();
  EXPECT_EQ(hub.sessions(), 0u);
  EXPECT_FALSE(hub.wanted(newest));
}

}  // namespace
}  // namespace saker::flight::ground
