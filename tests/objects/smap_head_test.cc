#include "saker/objects/smap_head.h"

#include <gtest/gtest.h>

#include <functional>

#include "saker/core/error.h"

namespace saker::objects {
namespace {

SmapHead made() {
  SmapHead head;
  head.steps.position_m = 0.05;
  head.steps.tile_bits = 10;
  head.frame = "world é";
  head.classes = {{"vehicle", Shape::cuboid}, {"trunk", Shape::cylinder}, {"ground", Shape::plane}};
  head.tiles = {{-3, 7, 12, 4, 130, 60, 900}, {0, 0, 1, 0, 14, 0, 0}, {5, -9, 0, 2, 0, 40, 0}};
  return head;
}

std::string refusal(const std::function<void()>& f) {
  try {
    f();
  } catch (const Error& error) {
    return error.what();
  }
  return "none";
}

/// What a reader says of a head that `spoil` has changed.
std::string refusal_of(const std::function<void(SmapHead&)>& spoil) {
  SmapHead head = made();
  spoil(head);
  return refusal([&] { (void)unpack_head(pack_head(head)); });
}

TEST(SmapHead, ComesBackAsItWasPacked) {
  const SmapHead head = unpack_head(pack_head(made()));
  EXPECT_EQ(head.steps.position_m, 0.05);
  EXPECT_EQ(head.steps.tile_bits, 10);
  EXPECT_EQ(head.frame, made().frame);
  ASSERT_EQ(head.classes.size(), 3u);
  EXPECT_EQ(head.classes[1].name, "trunk");
  EXPECT_EQ(head.classes[1].shape, Shape::cylinder);
  ASSERT_EQ(head.tiles.size(), 3u);
  EXPECT_EQ(head.tiles[0].y, 7);
  EXPECT_EQ(head.tiles[0].bytes(), 130 + 60 + 900);
  EXPECT_EQ(head.tiles[2].x, 5);
  EXPECT_EQ(head.tiles[2].planes, 2);
  EXPECT_EQ(pack_head(head), pack_head(made()));
}

TEST(SmapHead, WithoutTilesIsAHeadToo) {
  SmapHead head = made();
  head.tiles.clear();
  EXPECT_TRUE(unpack_head(pack_head(head)).tiles.empty());
}

TEST(SmapHead, TilesThatCannotBeAreRefused) {
  EXPECT_EQ(refusal_of([](SmapHead&) {}), "none");
  EXPECT_EQ(refusal_of([](SmapHead& h) { h.tiles[0].x = std::int64_t{1} << 50; }),
            "a tile lies too far out");
  EXPECT_EQ(refusal_of([](SmapHead& h) { h.tiles[0].ground_bytes = -1; }),
            "a tile's length is impossible");
  EXPECT_EQ(refusal_of([](SmapHead& h) { h.tiles[0].objects = 131; }),
            "a tile holds more than fits into its bytes");
  EXPECT_EQ(refusal_of([](SmapHead& h) { h.tiles[0].planes = -2; }),
            "a tile holds more than fits into its bytes");
}

TEST(SmapHead, NamesThatCannotBeShownAreRefused) {
  EXPECT_EQ(refusal_of([](SmapHead& h) { h.frame = "a\nb"; }), "a name with control characters");
  EXPECT_EQ(refusal_of([](SmapHead& h) { h.classes[0].name = "\xFF\xFE"; }),
            "a name that is not UTF-8");
}

TEST(SmapHead, StepsOutOfTheirBoundsAreRefused) {
  EXPECT_NE(refusal_of([](SmapHead& h) { h.steps.size_m = 0; }).find("steps.size_m: 0"),
            std::string::npos);
  EXPECT_NE(refusal_of([](SmapHead& h) { h.steps.tile_bits = 60; }).find("tile_bits"),
            std::string::npos);
  EXPECT_EQ(refusal_of([](SmapHead& h) { h.steps.angle_deg = NAN; }), "a step is not a number");
}

TEST(SmapHead, EveryCutOfItIsRefused) {
  const std::string bytes = pack_head(made());
  for (std::size_t size = 0; size + 1 < bytes.size(); ++size) {
    EXPECT_NE(refusal([&] { (void)unpack_head(bytes.substr(0, size)); }), "none") << size;
  }
}

TEST(SmapTile, ReachesOverItsSquareAndTheRimOfRounding) {
  const SmapSteps steps;
  const Eigen::AlignedBox2d extent = SmapTile{-2, 3}.extent(steps);
  const double tile = steps.tile_m();
  EXPECT_NEAR(tile, 0.02 * 4096, 1e-12);
  EXPECT_TRUE(extent.contains(Eigen::Vector2d(-2 * tile, 3 * tile)));
  EXPECT_TRUE(extent.contains(Eigen::Vector2d(-tile + 0.01, 4 * tile + 0.01)));
  EXPECT_FALSE(extent.contains(Eigen::Vector2d(-tile + 0.1, 3.5 * tile)));
}

TEST(SmapFrame, WordsAreLittleEndian) {
  EXPECT_EQ(word(0x01020304), std::string("\x04\x03\x02\x01"));
  for (const std::uint32_t value : {0U, 1U, 0x80000000U, 0xFFFFFFFFU}) {
    EXPECT_EQ(word_at("xy" + word(value) + "z", 2), value);
  }
}

TEST(SmapFrame, HoldsItsContentAndItsVersion) {
  for (const std::string& content :
       {std::string(), std::string("a\0b", 3), std::string(999, 'x')}) {
    const std::string frame = framed(kSmapVersion, content);
    EXPECT_EQ(version_of(frame), kSmapVersion);
    EXPECT_EQ(bytes_of(frame), frame.size());
    EXPECT_EQ(content_of(frame), content);
  }
}

TEST(SmapFrame, EveryFlippedByteOfItIsRefused) {
  const std::string frame = framed(kSmapVersion, "the content");
  for (std::size_t i = 0; i < frame.size(); ++i) {
    if (i >= 4 && i < 8) continue;  // the version has no checksum: a reader refuses others
    std::string damaged = frame;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x10);
    EXPECT_NE(refusal([&] { (void)content_of(damaged); }), "none") << i;
  }
}

TEST(SmapFrame, WhatIsShorterThanOneIsNoFile) {
  EXPECT_EQ(refusal([] { (void)version_of("SMAP"); }), "4 bytes, expected a .smap file");
  EXPECT_EQ(refusal([] { (void)version_of(std::string(40, 'x')); }),
            "40 bytes, expected a .smap file");
  const std::string frame = framed(kSmapVersion, "abc");
  EXPECT_NE(refusal([&] { (void)content_of(frame.substr(0, 17)); }).find("(cut?)"),
            std::string::npos);
}

}  // namespace
}  // namespace saker::objects
