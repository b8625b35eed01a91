#include "saker/core/moved_keys.h"

#include <gtest/gtest.h>

namespace saker::core {
namespace {

constexpr MovedKey kMoved[] = {
    {"a.b", "c.d", ""}, {"a.group", "other.group", ""}, {"a.gone", nullptr, "c is enough"}};

std::string moved(const std::string& yaml) {
  YAML::Node root = YAML::Load(yaml);
  (void)move_keys(root, kMoved);
  YAML::Emitter out;
  out.SetMapFormat(YAML::Flow);
  out << root;
  return out.c_str();
}

TEST(MovedKeys, AreTakenToTheirNewPlace) {
  EXPECT_EQ(moved("{a: {b: 1}}"), "{c: {d: 1}}");
  EXPECT_EQ(moved("{a: {b: 1, kept: 2}, c: {e: 3}}"), "{a: {kept: 2}, c: {e: 3, d: 1}}");
}

TEST(MovedKeys, GroupsAreJoined) {
  EXPECT_EQ(moved("{a: {group: {x: 1, y: 2}}, other: {group: {x: 5}}}"),
            "{other: {group: {x: 5, y: 2}}}");
}

TEST(MovedKeys, ANewKeyWins) { EXPECT_EQ(moved("{a: {b: 1}, c: {d: 2}}"), "{c: {d: 2}}"); }

TEST(MovedKeys, WhatIsGoneIsTakenOut) { EXPECT_EQ(moved("{a: {gone: [1, 2]}, c: 1}"), "{c: 1}"); }

TEST(MovedKeys, OthersAndWhatIsNoGroupStay) {
  EXPECT_EQ(moved("{a: 3, c: {d: 1}}"), "{a: 3, c: {d: 1}}");
  EXPECT_EQ(moved("[1, 2]"), "[1, 2]");
}

TEST(MovedKeys, EachValueHasALine) {
  YAML::Node root = YAML::Load("{a: {group: {x: 1, y: {z: 2}}, gone: {p: 1}}}");
  EXPECT_EQ(move_keys(root, kMoved),
            (std::vector<std::string>{"a.group.x: is now other.group.x",
                                      "a.group.y.z: is now other.group.y.z",
                                      "a.gone.p: is gone and ignored: c is enough"}));
}

}  // namespace
}  // namespace saker::core
