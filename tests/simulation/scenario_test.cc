#include "saker/simulation/mission/scenario.h"

#include <gtest/gtest.h>

#include <set>

#include "saker/core/config_io.h"
#include "saker/core/error.h"

namespace saker::simulation {
namespace {

Scenario read(const std::string& yaml) {
  return core::config_from_yaml(yaml, "a.yaml", Scenario{});
}

/// What reading says is wrong; empty where it is not.
std::string complaint(const std::string& yaml) {
  try {
    (void)read(yaml);
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

bool names(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(Scenario, WhatIsNotSaidIsTheDefault) {
  const Scenario s = read("kind: mission\n");
  EXPECT_EQ(s.kind, ScenarioKind::mission);
  EXPECT_EQ(s.mission.site.targets, MissionSiteConfig().targets);
  EXPECT_EQ(s.flight.duration_s, FlightConfig().duration_s);
}

TEST(Scenario, EachKindIsReadByItsName) {
  const auto kinds = enum_names(ScenarioKind::training);
  for (std::size_t i = 0; i < kinds.size(); ++i)
    EXPECT_EQ(static_cast<std::size_t>(read("kind: " + kinds[i] + "\n").kind), i);
}

TEST(Scenario, AnUnknownKindIsRefusedWithThoseThatThereAre) {
  const std::string text = complaint("kind: cruise\n");
  EXPECT_TRUE(names(text, "kind")) << text;
  EXPECT_TRUE(names(text, "spiral")) << text;
}

TEST(Scenario, AnUnknownKeyIsRefusedByName) {
  const std::string text = complaint("kind: mission\nmission:\n  site:\n    traget: 3\n");
  EXPECT_TRUE(names(text, "traget")) << text;
  EXPECT_TRUE(names(text, "a.yaml")) << text;
}

TEST(Scenario, AValueOutOfItsBoundsIsRefusedWithThem) {
  const std::string text = complaint("mission:\n  site:\n    targets: 0\n");
  EXPECT_TRUE(names(text, "targets")) << text;
  EXPECT_TRUE(names(text, "1")) << text;
  EXPECT_TRUE(names(text, "100")) << text;
}

TEST(Scenario, AWordWhereANumberBelongsIsRefused) {
  EXPECT_TRUE(names(complaint("flight:\n  speed_mps: fast\n"), "speed_mps"));
}

TEST(Scenario, EveryBoundedNumberOfAMissionIsCheckedAtBothEnds) {
  for (const char* key : {"mission.wind.gust_mps", "mission.battery.charge",
                          "mission.airframe.mass_kg", "mission.site.parked_share",
                          "mission.receiver.drop_share", "spiral.duration_s", "flight.sway_m"}) {
    for (const char* value : {"-1e6", "1e6"}) {
      EXPECT_THROW((void)core::config_with_setting(std::string(key) + "=" + value, Scenario{}),
                   Error)
          << key;
    }
  }
}

TEST(Scenario, EventsAreAList) {
  const Scenario s = read(
      "mission:\n  events:\n    - {kind: gust, at_s: 3, gust_mps: 7}\n"
      "    - {kind: lidar_stop, at_s: 9}\n");
  ASSERT_EQ(s.mission.events.size(), 2U);
  EXPECT_EQ(s.mission.events[0].kind, ScenarioEventKind::gust);
  EXPECT_EQ(s.mission.events[0].gust_mps, 7);
  EXPECT_EQ(s.mission.events[1].kind, ScenarioEventKind::lidar_stop);
  EXPECT_EQ(s.mission.events[1].gust_mps, ScenarioEvent().gust_mps);
}

TEST(Scenario, AnEventOfAnUnknownKindIsRefused) {
  EXPECT_TRUE(names(complaint("mission:\n  events:\n    - {kind: hail}\n"), "hail"));
}

TEST(Scenario, WhatIsWrittenIsReadAgain) {
  Scenario s;
  s.kind = ScenarioKind::spiral;
  s.spiral.clutter = 5;
  s.mission.site.kind = SiteKind::garage;
  s.mission.events.push_back({ScenarioEventKind::gust, 4});
  const Scenario again = read(core::config_to_yaml(s));
  EXPECT_EQ(again.kind, ScenarioKind::spiral);
  EXPECT_EQ(again.spiral.clutter, 5);
  EXPECT_EQ(again.mission.site.kind, SiteKind::garage);
  ASSERT_EQ(again.mission.events.size(), 1U);
  EXPECT_EQ(again.mission.events[0].at_s, 4);
}

TEST(Scenario, NoKeyIsListedTwice) {
  const std::vector<std::string> keys = core::config_keys(Scenario{});
  const std::set<std::string> once(keys.begin(), keys.end());
  EXPECT_EQ(once.size(), keys.size());
  EXPECT_GT(keys.size(), 100U);
}

TEST(Scenario, NamesOfWorldsAreInTheOrderOfTheirKinds) {
  EXPECT_EQ(read("training:\n  world: mixed\n").training.world, WorldKind::mixed);
  EXPECT_EQ(read("training:\n  world: square\n").training.world, WorldKind::square);
  EXPECT_EQ(read("training:\n  world: car_park\n").training.world, WorldKind::car_park);
}

TEST(Scenario, NamesOfSensorsAreInTheOrderOfTheirTable) {
  for (std::size_t i = 0; i < sensor_models().size(); ++i) {
    const Scenario s = read("training:\n  sensor: " + sensor_models()[i].name + "\n");
    EXPECT_EQ(sensor_model(s.training.sensor).name, sensor_models()[i].name);
  }
}

}  // namespace
}  // namespace saker::simulation
