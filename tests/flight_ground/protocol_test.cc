#include "flight/ground/protocol.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

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

/// Playback control: command, speed, whether it seeks, where to, and its id.
std::vector<std::uint8_t> control(std::uint8_t command, float speed, bool seeks, std::uint64_t seek,
                                  const std::string& request) {
  std::vector<std::uint8_t> message = {3, command};
  const auto add = [&](std::uint64_t value, int size) {
    for (int i = 0; i < size; ++i) message.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
  };
  add(std::bit_cast<std::uint32_t>(speed), 4);
  add(seeks ? 1 : 0, 1);
  add(seek, 8);
  add(request.size(), 4);
  message.insert(message.end(), request.begin(), request.end());
  return message;
}

TEST(Protocol, PlaybackWithoutASeekStaysWhereItIs) {
  const auto parsed = bytes(control(1, 2, false, 77, ""));
  ASSERT_TRUE(is<PlaybackControl>(parsed));
  EXPECT_FALSE(std::get<PlaybackControl>(parsed).playing);
  EXPECT_EQ(std::get<PlaybackControl>(parsed).seek, std::nullopt);
}

TEST(Protocol, PlaybackOfNoNumberIsGarbage) {
  for (const float speed : {NAN, INFINITY, -INFINITY})
    EXPECT_TRUE(is<Garbage>(bytes(control(0, speed, false, 0, "")))) << speed;
  EXPECT_TRUE(is<Garbage>(bytes(control(2, 1, false, 0, ""))));
  EXPECT_TRUE(is<Garbage>(bytes(control(0, 1, true, UINT64_MAX, ""))));
  EXPECT_TRUE(is<PlaybackControl>(bytes(control(0, 1, true, INT64_MAX, ""))));
}

/// It is said to every client: one must not make the server say kilobytes to all.
TEST(Protocol, TheIdOfPlaybackIsShort) {
  EXPECT_TRUE(is<PlaybackControl>(bytes(control(0, 1, false, 0, std::string(256, 'i')))));
  EXPECT_TRUE(is<Garbage>(bytes(control(0, 1, false, 0, std::string(257, 'i')))));
}

TEST(Protocol, EveryMessageThatIsCutIsGarbage) {
  const std::vector<std::vector<std::uint8_t>> whole = {
      control(0, 1, true, 5, "some-id"),
      {2, 4, 0, 0, 0, 9, 0, 0, 0, 4, 0, 0, 0, 'j', 's', 'o', 'n'}};
  for (const auto& message : whole) {
    EXPECT_FALSE(is<Garbage>(bytes(message)));
    for (std::size_t size = 0; size < message.size(); ++size) {
      const std::vector<std::uint8_t> cut(message.begin(),
                                          message.begin() + static_cast<std::ptrdiff_t>(size));
      EXPECT_TRUE(is<Garbage>(bytes(cut))) << size;
    }
  }
}

TEST(Protocol, EveryTextThatIsCutIsGarbage) {
  const std::string whole = R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":2}]})";
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_TRUE(is<Garbage>(text(whole.substr(0, size)))) << size;
}

TEST(Protocol, WhateverTheBytesItNeverThrows) {
  std::mt19937 random(3);
  for (int round = 0; round < 20000; ++round) {
    std::vector<std::uint8_t> message(random() % 40);
    for (std::uint8_t& byte : message) byte = static_cast<std::uint8_t>(random());
    if (!message.empty()) message[0] = static_cast<std::uint8_t>(random() % 5);
    EXPECT_NO_THROW(static_cast<void>(bytes(message)));
    EXPECT_NO_THROW(static_cast<void>(parse_client_message(message, false)));
  }
}

TEST(Protocol, TextOfNoUtf8IsGarbage) {
  EXPECT_TRUE(is<Garbage>(text("{\"op\":\"subscribe\",\"x\":\"\xc3\x28\",\"subscriptions\":[]}")));
}

TEST(Protocol, TheLargestIdsAreIds) {
  const auto message = text(
      R"({"op":"subscribe","subscriptions":[{"id":4294967295,"channelId":18446744073709551615}]})");
  ASSERT_TRUE(is<Subscribe>(message));
  EXPECT_EQ(std::get<Subscribe>(message).subscriptions[0].id, UINT32_MAX);
  EXPECT_EQ(std::get<Subscribe>(message).subscriptions[0].channel, UINT64_MAX);
}

TEST(Protocol, MoreSubscriptionsThanThereCanBeChannelsAreGarbage) {
  Json ids = Json::array();
  for (int i = 0; i < 4097; ++i) ids.push_back(i);
  const auto asked = [](const Json& list) {
    return text(Json({{"op", "unsubscribe"}, {"subscriptionIds", list}}).dump());
  };
  EXPECT_TRUE(is<Garbage>(asked(ids)));
  ids.erase(0);
  EXPECT_TRUE(is<Unsubscribe>(asked(ids)));
}

TEST(Protocol, AMessageMayHave64Kilobytes) {
  EXPECT_FALSE(is<Garbage>(bytes({1})));
  EXPECT_TRUE(is<Garbage>(bytes({})));
  std::vector<std::uint8_t> largest(kMostClientBytes, 0);
  largest[0] = 1;
  EXPECT_TRUE(is<NotOffered>(bytes(largest)));
  largest.push_back(0);
  EXPECT_TRUE(is<Garbage>(bytes(largest)));
}

TEST(Protocol, PlaybacksStateHasTheBytesOfTheSdk) {
  EXPECT_EQ(playback_state(PlaybackStatus::paused, 258, 1, true, "r"),
            std::string("\5\1\2\1\0\0\0\0\0\0\0\0\x80\x3f\1\1\0\0\0r", 20));  // 1.0f is 3f800000
}

TEST(Protocol, AFailureNamesItsServiceAndCall) {
  EXPECT_EQ(Json::parse(service_failure(3, 4294967295, "no")), Json({{"op", "serviceCallFailure"},
                                                                     {"serviceId", 3},
                                                                     {"callId", 4294967295},
                                                                     {"message", "no"}}));
}

TEST(Protocol, AStatusHasAnIdWhereItIsGivenOne) {
  EXPECT_FALSE(Json::parse(status(1, "a")).contains("id"));
  EXPECT_EQ(Json::parse(status(1, "a", "drops"))["id"], "drops");
}

TEST(Protocol, WhatTheServerSaysIsUtf8WhateverItWasGiven) {
  const Json said = Json::parse(status(2, "robot said \xff"));
  EXPECT_EQ(said["message"], "robot said \xef\xbf\xbd");  // U+FFFD
}

TEST(Protocol, AServiceIsAdvertisedWithBothSchemas) {
  const Json said = Json::parse(advertise_services({{2, "order", R"({"a":1})", R"({"b":1})"}}));
  const Json& service = said["services"][0];
  EXPECT_EQ(service["id"], 2);
  EXPECT_EQ(service["request"]["schema"], R"({"a":1})");
  EXPECT_EQ(service["response"]["schema"], R"({"b":1})");
  EXPECT_EQ(service["request"]["encoding"], "json");
}

}  // namespace
}  // namespace saker::flight::ground
