#include "flight/ground/protocol.h"

#include <gtest/gtest.h>

#include <bit>
#include <nlohmann/json.hpp>

namespace saker::flight::ground {
namespace {

using Json = nlohmann::ordered_json;

ClientMessage text(const std::string& message) {
  return parse_client_message(
      {reinterpret_cast<const std::uint8_t*>(message.data()), message.size()}, false);
}

ClientMessage bytes(const std::vector<std::uint8_t>& message) {
  return parse_client_message(message, true);
}

template <class T>
bool is(const ClientMessage& message) {
  return std::holds_alternative<T>(message);
}

TEST(Protocol, ASubscriptionNamesItsOwnIdAndTheChannel) {
  const auto message =
      text(R"({"op":"subscribe","subscriptions":[{"id":0,"channelId":3},{"id":7,"channelId":5}]})");
  ASSERT_TRUE(is<Subscribe>(message));
  const auto& list = std::get<Subscribe>(message).subscriptions;
  ASSERT_EQ(list.size(), 2u);
  EXPECT_EQ(list[1].id, 7u);
  EXPECT_EQ(list[1].channel, 5u);
  const auto end = text(R"({"op":"unsubscribe","subscriptionIds":[7]})");
  ASSERT_TRUE(is<Unsubscribe>(end));
  EXPECT_EQ(std::get<Unsubscribe>(end).ids, std::vector<std::uint32_t>{7});
}

TEST(Protocol, WhatIsNotOfItIsGarbage) {
  for (const char* message :
       {"", "x", "{}", "[]", "null", R"({"op":1})", R"({"op":"dance"})", R"({"op":"subscribe"})",
        R"({"op":"subscribe","subscriptions":{}})", R"({"op":"subscribe","subscriptions":[1]})",
        R"({"op":"subscribe","subscriptions":[{"id":-1,"channelId":3}]})",
        R"({"op":"subscribe","subscriptions":[{"id":4294967296,"channelId":3}]})",
        R"({"op":"subscribe","subscriptions":[{"id":1.5,"channelId":3}]})",
        R"({"op":"unsubscribe","subscriptionIds":["a"]})"})
    EXPECT_TRUE(is<Garbage>(text(message))) << message;
  EXPECT_TRUE(is<Garbage>(text(std::string(kMostClientBytes + 1, ' '))));
  EXPECT_TRUE(is<Garbage>(text(std::string(60000, '['))));
  EXPECT_TRUE(is<Garbage>(bytes({9, 1, 2})));
  EXPECT_TRUE(is<Garbage>(bytes({2, 1, 0, 0})));
  EXPECT_TRUE(is<Garbage>(bytes({2, 1, 0, 0, 0, 1, 0, 0, 0, 255, 255, 255, 255, 'j'})));
  EXPECT_TRUE(is<Garbage>(bytes({3, 2, 0, 0, 0, 0, 0})));
}

TEST(Protocol, WhatIsNotOfferedIsNoGarbage) {
  EXPECT_TRUE(is<NotOffered>(text(R"({"op":"getParameters","parameterNames":[]})")));
  EXPECT_TRUE(is<NotOffered>(bytes({1, 0, 0, 0, 0, 'x'})));
}

TEST(Protocol, AServiceCallHasItsPayload) {
  const auto message = bytes({2, 4, 0, 0, 0, 9, 0, 0, 0, 4, 0, 0, 0, 'j', 's', 'o', 'n', '{', '}'});
  ASSERT_TRUE(is<ServiceCall>(message));
  const auto& call = std::get<ServiceCall>(message);
  EXPECT_EQ(call.service, 4u);
  EXPECT_EQ(call.call, 9u);
  EXPECT_EQ(call.encoding, "json");
  EXPECT_EQ(call.payload, "{}");
}

/// The example of the SDK's own test: play at 1.5, seek to the nanosecond 100500000000, "some-id".
TEST(Protocol, PlaybackControlIsThatOfTheSdk) {
  std::vector<std::uint8_t> message = {3, 0};
  const auto add = [&](std::uint64_t value, int size) {
    for (int i = 0; i < size; ++i) message.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
  };
  add(std::bit_cast<std::uint32_t>(1.5f), 4);
  add(1, 1);
  add(100500000000, 8);
  add(7, 4);
  for (const char c : std::string("some-id")) message.push_back(static_cast<std::uint8_t>(c));
  const auto parsed = bytes(message);
  ASSERT_TRUE(is<PlaybackControl>(parsed));
  const auto& control = std::get<PlaybackControl>(parsed);
  EXPECT_TRUE(control.playing);
  EXPECT_EQ(control.speed, 1.5);
  EXPECT_EQ(control.seek, 100500000000);
  EXPECT_EQ(control.request, "some-id");
}

TEST(Protocol, TheServerSaysWhatItOffers) {
  const Json live = Json::parse(
      server_info({.mode = "live", .version = "1", .session = "s", .begin = {}, .end = {}}));
  EXPECT_EQ(live["op"], "serverInfo");
  EXPECT_EQ(live["capabilities"], Json::array({"services"}));
  EXPECT_FALSE(live.contains("dataStartTime"));
  const Json run = Json::parse(server_info(
      {.mode = "run", .version = "1", .session = "s", .begin = 1500000000, .end = 2500000000}));
  EXPECT_EQ(run["capabilities"], Json::array({"services", "time", "playbackControl"}));
  EXPECT_EQ(run["dataStartTime"], Json({{"sec", 1}, {"nsec", 500000000}}));
}

TEST(Protocol, NumbersInBinaryMessagesAreLittleEndian) {
  EXPECT_EQ(message_head(0x0102, 3), std::string("\1\2\1\0\0\3\0\0\0\0\0\0\0", kMessageHead));
  EXPECT_EQ(time_message(1), std::string("\2\1\0\0\0\0\0\0\0", 9));
  EXPECT_EQ(service_response(1, 2, "{}"), std::string("\3\1\0\0\0\2\0\0\0\4\0\0\0json{}", 19));
  EXPECT_EQ(playback_state(PlaybackStatus::ended, 1, 1, true, "r").size(), 20u);
}

TEST(Protocol, AnAdvertisementIsJsonWithASchema) {
  const Json said = Json::parse(advertise({{4, "/R1/a", "saker.A", R"({"type":"object"})"}}));
  const Json& channel = said["channels"][0];
  EXPECT_EQ(channel["id"], 4);
  EXPECT_EQ(channel["encoding"], "json");
  EXPECT_EQ(channel["schemaEncoding"], "jsonschema");
  EXPECT_EQ(Json::parse(channel["schema"].get<std::string>())["type"], "object");
}

}  // namespace
}  // namespace saker::flight::ground
