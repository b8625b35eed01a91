#include <gtest/gtest.h>

#include <regex>

#include "flight_viewers/made_robot.h"
#include "flight_viewers/schema_check.h"
#include "paths.h"
#include "saker/core/files.h"

namespace saker::flight::viewers {
namespace {

using namespace testing;

/// A view that has heard something of everything.
RobotView full_view() {
  auto site = made_site();
  site->origin = {.latitude_deg = 47, .longitude_deg = 8, .heading_deg = 0};
  site->prior.objects = {made_vehicle(31, 10.5, 0), made_vehicle(32, 30, 0)};
  RobotView view = made_view(site, 1.5);
  EXPECT_TRUE(view.hear(made_state(), 1));
  EXPECT_TRUE(view.hear(made_odometry(1, 1, 2), 1));
  EXPECT_TRUE(view.hear(made_trajectory(4, 50), 1));
  EXPECT_TRUE(view.hear(made_plan({31, 32}, 4), 1));
  EXPECT_TRUE(view.hear(made_mission("hold", autonomy::Cause::lidar_silent, "no scan"), 1));
  verdict_t verdict{};
  verdict.clear_until_utime = 2000000;
  EXPECT_TRUE(view.hear(verdict, 1));
  objects::Detections window;
  const objects::MapObject vehicle = made_vehicle(0, 4, 0), pole = made_pole(1, 2, 2);
  for (const objects::MapObject& o : {vehicle, pole}) {
    window.measurements.push_back({.class_id = o.class_id,
                                   .class_probability = o.class_probability,
                                   .model = o.model,
                                   .covariance = {}});
  }
  EXPECT_TRUE(view.hear(to_lcm(window), 1));
  EXPECT_TRUE(view.hear(made_objects({made_vehicle(3, 10, 0), made_pole(5, 1, 1)}), 1));
  health_t health{};
  health.process = "saker-flight";
  health.loops.resize(1);
  health.loops[0].rate_hz = NAN;
  health.counters = {{"drops", 3}};
  EXPECT_TRUE(view.hear(health, 1));
  view.hear(made_scan(100), 1);
  occupancy::OccupancyGrid grid{
      .resolution_m = 0.5, .origin = {0, 0, 2.5}, .size = {4, 1, 1}, .cells = {}};
  grid.cells = {occupancy::Cell::occupied, occupancy::Cell::free, occupancy::Cell::unknown,
                occupancy::Cell::occupied};
  view.hear(grid, 1);
  view.set_figures({{"scenario", "demo"}});
  view.say_order({{"id", 1},
                  {"t_s", 1.0},
                  {"robot", "R1"},
                  {"kind", "hold"},
                  {"by", "127.0.0.1"},
                  {"state", "sent"},
                  {"text", ""}},
                 1);
  return view;
}

TEST(Topics, EveryOneSaysWhatItsSchemaSays) {
  RobotView view = full_view();
  const std::vector<Said> said = view.take_due(1.1, all);
  for (int i = 0; i < kTopics; ++i) {
    const auto topic = static_cast<Topic>(i);
    const std::vector<Json> messages = of_topic(said, topic);
    EXPECT_FALSE(messages.empty()) << info(topic).name;
    const Json schema = Json::parse(schema_of(topic));
    EXPECT_EQ(schema.at("title"), info(topic).schema);
    for (const Json& message : messages)
      EXPECT_EQ(against_schema(message, schema, info(topic).name), "");
  }
}

TEST(Topics, WhatIsNotKnownIsLeftOut) {
  RobotView view = made_view();
  vehicle_state_t state = made_state();
  state.battery_share = NAN;
  view.hear(state, 1);
  odometry_t odometry = made_odometry(1, 0, 0);
  std::fill_n(odometry.covariance, 36, NAN);
  view.hear(odometry, 1);
  for (const Said& said : view.take_due(1, all)) {
    EXPECT_EQ(said.json.find("null"), std::string::npos) << said.json;
    const Json schema = Json::parse(schema_of(said.topic));
    EXPECT_EQ(against_schema(Json::parse(said.json), schema, info(said.topic).name), "");
  }
}

TEST(Topics, TheCheckFindsWhatIsWrong) {
  const Json schema = Json::parse(schema_of(Topic::verdict));
  Json verdict = Json::parse(R"({"utime": 1, "trajectory_id": 1, "clear": true, "reason": "none",
                                 "clear_for_s": 1.5})");
  EXPECT_EQ(against_schema(verdict, schema, "v"), "");
  verdict["clear"] = 1;
  EXPECT_EQ(against_schema(verdict, schema, "v"), "v.clear: 1, expected boolean");
  verdict.erase("clear");
  EXPECT_EQ(against_schema(verdict, schema, "v"), "v: no \"clear\"");
}

/// {name of a topic: its example} of the page.
std::map<std::string, Json> examples() {
  const std::string page = core::read_file(source_dir() + "/flight/viewers/topics.md");
  static const std::regex name("`/R1/(\\w+)` \\(");
  std::map<std::string, Json> found;
  std::size_t at = 0;
  while ((at = page.find("```json\n", at)) != std::string::npos) {
    const std::string before = page.substr(0, at);
    const std::size_t end = page.find("```", at + 8);
    std::string topic;
    for (std::sregex_iterator i(before.begin(), before.end(), name), last; i != last; ++i)
      topic = (*i)[1];
    found[topic] = Json::parse(page.substr(at + 8, end - at - 8));
    at = end;
  }
  return found;
}

TEST(Topics, ThePageShowsThemAsTheyAre) {
  const std::map<std::string, Json> shown = examples();
  EXPECT_GE(shown.size(), 14u);
  for (const auto& [name, example] : shown) {
    bool known = false;
    for (int i = 0; i < kTopics; ++i) {
      const auto topic = static_cast<Topic>(i);
      if (name != info(topic).name) continue;
      known = true;
      EXPECT_EQ(against_schema(example, Json::parse(schema_of(topic)), name), "");
    }
    EXPECT_TRUE(known) << name;
  }
}

TEST(Topics, ARobotsTopicsBeginWithItsName) {
  EXPECT_EQ(topic_name("R7", Topic::objects), "/R7/objects");
  EXPECT_EQ(topic_name("R7", Topic::transforms), "/R7/tf");
}

}  // namespace
}  // namespace saker::flight::viewers
