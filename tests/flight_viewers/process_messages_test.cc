#include <gtest/gtest.h>

#include <limits>

#include "flight/viewers/own_messages.h"
#include "flight/viewers/schema_parts.h"
#include "flight_viewers/made_robot.h"
#include "saker/autonomy/config.h"
#include "saker/core/error.h"

namespace saker::flight::viewers {
namespace {

using namespace testing;

TEST(Link, ItsAgeIsThatOfTheNewestMessageOfAnyChannel) {
  RobotState state;
  state.heard = {{"STATE", 8}, {"PLAN", 9.5}};
  const Json link = link_message(state, 10, 1.5);
  EXPECT_EQ(link["age_s"], 0.5);
  EXPECT_EQ(link["lost"], false);
  EXPECT_EQ(link["channels"], Json({{"PLAN", 0.5}, {"STATE", 2.0}}));
}

TEST(Link, IsLostAfterSoLongASilenceAndNotBefore) {
  RobotState state;
  state.heard = {{"STATE", 8}};
  EXPECT_EQ(link_message(state, 9.5, 1.5)["lost"], false);
  EXPECT_EQ(link_message(state, 9.500001, 1.5)["lost"], true);
}

TEST(Link, OfWhomNothingWasHeardIsLostAndHasNoAge) {
  const Json link = link_message(RobotState(), 10, 1.5);
  EXPECT_EQ(link["lost"], true);
  EXPECT_FALSE(link.contains("age_s"));
}

TEST(Link, WhatIsHeardInTheFutureIsZeroSecondsOld) {
  RobotState state;
  state.heard = {{"STATE", 12}};
  EXPECT_EQ(link_message(state, 10, 1.5)["age_s"], 0);
}

TEST(Link, TheRateCountsTheLastSecond) {
  RobotState state;
  for (int i = 0; i < 30; ++i) state.arrivals.push_back(0.1 * i);
  EXPECT_EQ(link_message(state, 2.95, 1.5)["message_rate_hz"], 10);
}

TEST(Health, CountersAndLoopsAreThoseOfTheProcess) {
  health_t message{};
  message.process = "saker-flight";
  message.loops.resize(2);
  message.loops[0].name = "slam";
  message.loops[0].rate_hz = 2;
  message.loops[0].misses = 3;
  message.loops[1].name = "planner";
  message.loops[1].rate_hz = NAN;
  message.counters = {{"scan_drops", 7}, {"resets", 0}};
  const Json json = health_message(message);
  EXPECT_EQ(json["process"], "saker-flight");
  EXPECT_EQ(json["loops"][0]["rate_hz"], 2);
  EXPECT_EQ(json["loops"][0]["misses"], 3);
  EXPECT_FALSE(json["loops"][1].contains("rate_hz"));
  EXPECT_EQ(json["counters"], Json({{"scan_drops", 7}, {"resets", 0}}));
}

TEST(Health, NamesOfNoUtf8BreakNoMessage) {
  health_t message{};
  message.process = "p\xff";
  message.counters = {{"\xc0", 1}};
  RobotView view = made_view();
  view.hear(message, 1);
  const auto said = of_topic(view.take_due(1, none), Topic::health);
  ASSERT_EQ(said.size(), 1u);
  EXPECT_EQ(said[0]["process"], "p\xef\xbf\xbd");
}

TEST(SiteMessage, NamesTheClassesThatAreDrawn) {
  const Json site = *made_view().message(Topic::site, 0);
  for (const Json& c : site["classes"]) {
    EXPECT_TRUE(c["shape"] == "cuboid" || c["shape"] == "cylinder") << c["name"];
    EXPECT_NE(c["name"], "other");
  }
  EXPECT_GE(site["classes"].size(), 3u);
}

TEST(SiteMessage, APriorMapsObjectsAreNoTargetsOfAnything) {
  auto site = made_site();
  site->prior.objects = {made_vehicle(31, 1, 2)};
  const Json prior = (*made_view(site).message(Topic::site, 0))["prior"]["objects"];
  ASSERT_EQ(prior.size(), 1u);
  EXPECT_EQ(prior[0]["id"], 31);
  EXPECT_FALSE(prior[0].contains("target"));
}

TEST(SiteMessage, HasTheFenceTheLimitsAndAnOriginWhereThereIsOne) {
  auto site = made_site();
  EXPECT_FALSE(made_view(site).message(Topic::site, 0)->contains("origin"));
  site->origin = {.latitude_deg = 47, .longitude_deg = 8, .heading_deg = 12};
  site->battery_return_share = 0.4;
  const Json said = *made_view(site).message(Topic::site, 0);
  EXPECT_EQ(said["origin"]["heading_deg"], 12);
  EXPECT_EQ(said["limits"]["battery_return_share"], 0.4);
  EXPECT_EQ(said["geofence"]["polygon"].size(), 4u);
  EXPECT_EQ(said["geofence"]["polygon"][1], Json::array({5, -5}));
}

TEST(SiteOf, AnOriginIsTwoOrThreeNumbers) {
  const autonomy::Config config;
  EXPECT_FALSE(site_of(config, {}).origin);
  EXPECT_EQ(site_of(config, {47, 8}).origin->heading_deg, 90);
  EXPECT_EQ(site_of(config, {47, 8, 10}).origin->heading_deg, 10);
  for (const std::vector<double>& wrong :
       {std::vector<double>{47}, {1, 2, 3, 4}, {91, 8}, {NAN, 8}})
    EXPECT_THROW(static_cast<void>(site_of(config, wrong)), Error) << wrong.size();
}

TEST(SiteOf, LimitsAreThoseOfTheFlight) {
  autonomy::Config config;
  config.safety.land_after_s = 17;
  config.safety.battery_land_share = 0.2;
  config.motion.geofence.highest_m = 33;
  const Site site = site_of(config, {});
  EXPECT_EQ(site.land_after_s, 17);
  EXPECT_EQ(site.battery_land_share, 0.2);
  EXPECT_EQ(site.geofence.highest_m, 33);
}

TEST(JsonValue, ANumberIsRoundedToAMillionthAndNoWorse) {
  EXPECT_EQ(rounded(1.2345674), 1.234567);
  EXPECT_EQ(rounded(-1.2345676), -1.234568);
  EXPECT_EQ(rounded(0), 0);
  EXPECT_EQ(rounded(1700000000.123456), 1700000000.123456);  // a system clock's second
}

TEST(JsonValue, AVectorIsThereWholeOrNotAtAll) {
  Json object = Json::object();
  put(object, "a", Eigen::Vector3d(1, 2, INFINITY));
  EXPECT_TRUE(object.empty());
  put(object, "a", Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(object["a"], (std::vector<double>{1, 2, 3}));
}

TEST(JsonValue, ARotationIsXyzw) {
  const Eigen::Quaterniond q(Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ()));
  EXPECT_EQ(array(q), (std::vector<double>{0, 0, 0.707107, 0.707107}));
}

TEST(JsonValue, Base64HasEveryByte) {
  std::vector<std::uint8_t> bytes;
  for (int i = 0; i < 256; ++i) bytes.push_back(static_cast<std::uint8_t>(i));
  const std::string text = base64(bytes);
  EXPECT_EQ(text.size(), 344u);
  EXPECT_EQ(text.substr(0, 8), "AAECAwQF");
  EXPECT_EQ(text.substr(336), "/P3+/w==");  // 252 … 255, by RFC 4648
}

TEST(Schema, ANameThatEndsInAQuestionMarkMayBeMissing) {
  const Json part = schema::object({{"a", schema::number()}, {"b?", schema::text("why")}}, "T");
  EXPECT_EQ(part["required"], Json::array({"a"}));
  EXPECT_TRUE(part["properties"].contains("b"));
  EXPECT_FALSE(part["properties"].contains("b?"));
  EXPECT_EQ(part["properties"]["b"]["description"], "why");
  EXPECT_FALSE(part["properties"]["a"].contains("description"));
  EXPECT_EQ(part["title"], "T");
}

TEST(Schema, AListNamesWhatIsInIt) {
  EXPECT_EQ(schema::numbers("m"),
            Json({{"type", "array"}, {"description", "m"}, {"items", {{"type", "number"}}}}));
}

}  // namespace
}  // namespace saker::flight::viewers
