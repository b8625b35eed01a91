#include "saker/core/config_value.h"

#include <gtest/gtest.h>

#include "saker/core/error.h"
#include "saker/core/rng.h"

namespace saker::core {
namespace {

template <class T>
T read_back(const T& value) {
  const std::vector<std::string> keys;
  T read{};
  read_value(parse_yaml(value_text(value), "text"),
             ConfigPlace("text", keys, ConfigPlace::Lines::shown), read);
  return read;
}

TEST(ConfigValue, EveryDoubleIsReadBackToTheLastBit) {
  Rng rng(1);
  for (int i = 0; i < 1000; ++i) {
    const double value = rng.normal() * std::pow(10, rng.uniform(-300, 300));
    EXPECT_EQ(read_back(value), value);
  }
  for (const double value : {0.0, -1.0, 1e-320, double{INFINITY}, -double{INFINITY}}) {
    EXPECT_EQ(read_back(value), value);
  }
}

TEST(ConfigValue, EveryTextIsReadBackTheSame) {
  for (const std::string text :
       {"",       "plain",    "two words", "true", "No",   "~",         "1e3",
        "-",      "a: b",     "#1",        "'",    "\"",   "\\",        "a\nb",
        "a\r\tb", "\x01\x7f", " padded ",  "é",    "[x]",  "{x: 1}",    "*a",
        "&a",     "!x",       "%",         "@",    "0x1F", "2026-01-01"}) {
    EXPECT_EQ(read_back(text), text);
  }
}

TEST(ConfigValue, ListsIntegersAndSwitchesAreReadBackTheSame) {
  EXPECT_EQ(read_back(std::vector<double>{1, -0.5, 1e9}), (std::vector<double>{1, -0.5, 1e9}));
  EXPECT_TRUE(read_back(std::vector<std::string>{}).empty());
  for (const int value : {0, -1, 2147483647, -2147483647 - 1}) EXPECT_EQ(read_back(value), value);
  EXPECT_TRUE(read_back(true));
  EXPECT_FALSE(read_back(false));
}

TEST(NearestKey, IsTheOneWithTheFewestEdits) {
  const std::vector<std::string> keys = {"speed", "height", "heights", "weight"};
  EXPECT_EQ(nearest_key("speed", keys), "speed");
  EXPECT_EQ(nearest_key("sped", keys), "speed");
  EXPECT_EQ(nearest_key("hieght", keys), "height");
  EXPECT_EQ(nearest_key("heightss", keys), "heights");
  EXPECT_EQ(nearest_key("wieght", {"height", "weight"}), "weight");
}

TEST(NearestKey, OfNoneIsEmptyAndOfEqualsTheFirst) {
  EXPECT_EQ(nearest_key("x", {}), "");
  EXPECT_EQ(nearest_key("ac", {"ab", "aa"}), "ab");
}

TEST(SettingAsYaml, NestsAsTheDotsSay) {
  const YAML::Node node = setting_as_yaml("a.b.c=1.5");
  EXPECT_EQ(node["a"]["b"]["c"].as<double>(), 1.5);
  EXPECT_EQ(node.size(), 1u);
}

TEST(SettingAsYaml, TakesAllAfterTheFirstEqualsSign) {
  EXPECT_EQ(setting_as_yaml("a=\"x=y.z\"")["a"].as<std::string>(), "x=y.z");
  EXPECT_EQ(setting_as_yaml("a=[1, 2]")["a"].size(), 2u);
}

TEST(SettingAsYaml, WithoutAKeyOrAValueIsRefused) {
  EXPECT_THROW((void)setting_as_yaml("a"), Error);
  EXPECT_THROW((void)setting_as_yaml("=1"), Error);
  EXPECT_THROW((void)setting_as_yaml("a=[1"), Error);
}

TEST(ParseYaml, SaysInWhichLineItFailed) {
  try {
    (void)parse_yaml("a: 1\nb: [\n", "f.yaml");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()).find("f.yaml:3: not YAML"), 0u) << error.what();
  }
}

TEST(ParseYaml, WhatStandsWithinItselfOrWithoutEndIsRefused) {
  EXPECT_THROW((void)parse_yaml("a: &x {b: *x}\n", "f.yaml"), Error);
  std::string bomb = "a0: &a0 [1]\n";
  for (int i = 1; i < 12; ++i) {
    const std::string before = fmt::format("*a{}", i - 1);
    bomb += fmt::format("a{0}: &a{0} [{1}, {1}, {1}, {1}, {1}, {1}]\n", i, before);
  }
  EXPECT_THROW((void)parse_yaml(bomb, "f.yaml"), Error);
  EXPECT_THROW((void)parse_yaml(std::string(60, '[') + std::string(60, ']'), "f.yaml"), Error);
  EXPECT_EQ(parse_yaml(std::string(40, '[') + std::string(40, ']'), "f.yaml").size(), 1u);
}

TEST(FieldComment, SaysUnitRangeAndMeaningWhereThereAreSome) {
  EXPECT_EQ(field_comment("m", {0, 2}, "height"), "m, 0 … 2: height");
  EXPECT_EQ(field_comment("", {0, 2}, "share"), "0 … 2: share");
  EXPECT_EQ(field_comment("m", {}, "height"), "m: height");
  EXPECT_EQ(field_comment("", {}, "name"), "name");
}

}  // namespace
}  // namespace saker::core
