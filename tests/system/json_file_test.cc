#include "tools/saker/evaluate/json_file.h"

#include <gtest/gtest.h>

#include <fstream>
#include <limits>

#include "saker/core/error.h"

namespace saker::tools {
namespace {

using nlohmann::json;

/// What an attempt complains of; empty where it does not.
template <class Attempt>
std::string complaint(Attempt attempt) {
  try {
    attempt();
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(JsonNode, ReadsEachKindOfValue) {
  const json value = {{"n", 2.5}, {"b", true}, {"t", "word"}, {"l", {1, 2, 3}}};
  const JsonNode node(value, "file");
  EXPECT_EQ(node.at("n").number(), 2.5);
  EXPECT_TRUE(node.at("b").boolean());
  EXPECT_EQ(node.at("t").text(), "word");
  EXPECT_EQ(node.at("l").numbers(3), (std::vector<double>{1, 2, 3}));
  EXPECT_TRUE(node.at("t").is_text());
  EXPECT_FALSE(node.at("n").is_text());
}

TEST(JsonNode, SaysWhetherAFieldIsThere) {
  const json value = {{"a", nullptr}}, list = {1};
  EXPECT_TRUE(JsonNode(value, "file").has("a"));
  EXPECT_FALSE(JsonNode(value, "file").has("b"));
  EXPECT_FALSE(JsonNode(list, "file").has("a"));
}

TEST(JsonNode, AMissingFieldIsNamedWithTheWayToIt) {
  const json value = {{"scans", {{"first", json::object()}}}};
  const std::string text =
      complaint([&] { (void)JsonNode(value, "map.json").at("scans").at("first").at("stamp"); });
  EXPECT_EQ(text, "map.json.scans.first.stamp: missing");
}

TEST(JsonNode, AValueOfAnotherKindIsShownWithWhatWasExpected) {
  const json value = {{"a", "seven"}};
  const JsonNode node = JsonNode(value, "file").at("a");
  EXPECT_EQ(complaint([&] { (void)node.number(); }), "file.a: \"seven\", expected a number");
  EXPECT_EQ(complaint([&] { (void)node.boolean(); }), "file.a: \"seven\", expected true or false");
  EXPECT_TRUE(contains(complaint([&] { (void)node.at("b"); }), "an object with fields"));
}

TEST(JsonNode, ALongValueIsShownInItsBeginning) {
  const json value = std::string(500, 'x');
  const std::string text = complaint([&] { (void)JsonNode(value, "file").number(); });
  EXPECT_LT(text.size(), 80U);
  EXPECT_TRUE(contains(text, "xxx..."));
}

TEST(JsonNode, WhatIsNotFiniteIsNoNumber) {
  const json value = std::numeric_limits<double>::infinity();
  EXPECT_NE(complaint([&] { (void)JsonNode(value, "file").number(); }), "");
}

TEST(JsonNode, AListOfAnotherLengthIsRefusedWithTheExpectedOne) {
  const json value = {1, 2};
  EXPECT_TRUE(
      contains(complaint([&] { (void)JsonNode(value, "file").numbers(3); }), "expected 3 numbers"));
}

TEST(JsonNode, AWrongElementIsNamedByItsIndex) {
  const json value = {1, "two", 3};
  EXPECT_TRUE(contains(complaint([&] { (void)JsonNode(value, "file").numbers(3); }), "file[1]"));
}

TEST(JsonNode, VisitsElementsAndFieldsInTheirOrder) {
  const json list = {5, 6, 7}, fields = {{"a", 1}, {"b", 2}};
  std::vector<double> seen;
  JsonNode(list, "file").each_element([&](const JsonNode& n) { seen.push_back(n.number()); });
  EXPECT_EQ(seen, (std::vector<double>{5, 6, 7}));
  std::string keys;
  JsonNode(fields, "file").each_field([&](const std::string& key, const JsonNode&) {
    keys += key;
  });
  EXPECT_EQ(keys, "ab");
}

TEST(JsonNode, OnlyListsHaveElementsAndOnlyObjectsFields) {
  const json number = 3;
  const JsonNode node(number, "file");
  EXPECT_TRUE(contains(complaint([&] { node.each_element([](const JsonNode&) {}); }), "a list"));
  EXPECT_TRUE(contains(
      complaint([&] { node.each_field([](const std::string&, const JsonNode&) {}); }), "fields"));
}

TEST(ReadJson, AFileThatIsNoJsonIsNamed) {
  const auto file = std::filesystem::path(testing::TempDir()) / "broken.json";
  std::ofstream(file) << "{\"a\": ";
  EXPECT_TRUE(contains(complaint([&] { (void)read_json(file); }), "broken.json"));
  std::ofstream(file) << "{\"a\": 4}";
  EXPECT_EQ(read_json(file)["a"], 4);
}

TEST(ReadJson, AMissingFileIsNamed) {
  EXPECT_TRUE(contains(complaint([] { (void)read_json("/nowhere/at_all.json"); }), "at_all.json"));
}

}  // namespace
}  // namespace saker::tools
