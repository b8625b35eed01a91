#include <gtest/gtest.h>

#include "flight/bus/chunk_joiner.h"
#include "saker/core/rng.h"

namespace saker::flight {
namespace {

constexpr std::int64_t kPeriod_us = 100000;

struct Part {
  static constexpr int MAX_CHUNKS = 8;
  std::int64_t utime;
  std::int32_t sequence;
  std::int16_t chunk, num_chunks;
};

/// Part `chunk` of the `n`th whole, which has four.
Part part(int n, int chunk) {
  return {(n + 1) * kPeriod_us, n, static_cast<std::int16_t>(chunk), 4};
}

using Joiner = ChunkJoiner<Part>;

bool adds(Joiner& joiner, int n, std::initializer_list<int> chunks) {
  bool whole = false;
  for (const int chunk : chunks) whole = joiner.add(part(n, chunk)).has_value() || whole;
  return whole;
}

TEST(ChunkJoiner, IsWholeWithTheLastMissingChunkInWhateverOrder) {
  Joiner joiner;
  EXPECT_FALSE(adds(joiner, 0, {2, 0, 3}));
  const auto whole = joiner.add(part(0, 1));
  ASSERT_TRUE(whole);
  for (int i = 0; i < 4; ++i) EXPECT_EQ((*whole)[i].chunk, i);
}

TEST(ChunkJoiner, ARepeatedChunkChangesNothing) {
  Joiner joiner;
  EXPECT_FALSE(adds(joiner, 0, {0, 0, 1, 2, 2}));
  EXPECT_TRUE(adds(joiner, 0, {3}));
  EXPECT_EQ(joiner.counters().repeated, 2);
}

TEST(ChunkJoiner, IsDeliveredOnceWhenEverythingComesTwice) {
  Joiner joiner;
  EXPECT_TRUE(adds(joiner, 0, {0, 1, 2, 3}));
  EXPECT_FALSE(adds(joiner, 0, {0, 1, 2, 3}));
  EXPECT_EQ(joiner.counters().late, 4);
}

TEST(ChunkJoiner, NeighboursMayBeMixed) {
  Joiner joiner;
  EXPECT_FALSE(adds(joiner, 0, {0, 1, 2}));
  EXPECT_FALSE(adds(joiner, 1, {0, 1}));
  EXPECT_TRUE(adds(joiner, 0, {3}));
  EXPECT_TRUE(adds(joiner, 1, {3, 2}));
}

TEST(ChunkJoiner, ALostChunkLosesOneWholeOnly) {
  Joiner joiner;
  EXPECT_FALSE(adds(joiner, 0, {0, 1, 3}));
  EXPECT_TRUE(adds(joiner, 1, {0, 1, 2, 3}));
  EXPECT_EQ(joiner.counters().incomplete, 1);
}

TEST(ChunkJoiner, WhatIsOlderThanTheLastOneDeliveredStaysAway) {
  Joiner joiner;
  EXPECT_TRUE(adds(joiner, 1, {0, 1, 2, 3}));
  EXPECT_FALSE(adds(joiner, 0, {0, 1, 2, 3}));
}

TEST(ChunkJoiner, AClockThatStartsAgainIsFollowed) {
  Joiner joiner;
  EXPECT_TRUE(adds(joiner, 1000, {0, 1, 2, 3}));
  EXPECT_TRUE(adds(joiner, 0, {0, 1, 2, 3}));
}

TEST(ChunkJoiner, RecoversFromOneForgedStampFarAhead) {
  Joiner joiner;
  EXPECT_TRUE(adds(joiner, 0, {0, 1, 2, 3}));
  EXPECT_FALSE(joiner.add({std::int64_t{1} << 60, 1, 0, 4}));
  int delivered = 0;
  for (int n = 1; n < 10; ++n) delivered += adds(joiner, n, {0, 1, 2, 3});
  EXPECT_EQ(delivered, 9);
}

TEST(ChunkJoiner, NumbersThatContradictThemselvesAreRefused) {
  Joiner joiner;
  for (const auto& [chunk, count] :
       {std::pair{0, 0}, {-1, 4}, {4, 4}, {0, -3}, {0, 9}, {0, 32767}}) {
    const Part wrong{kPeriod_us, 0, static_cast<std::int16_t>(chunk),
                     static_cast<std::int16_t>(count)};
    EXPECT_FALSE(joiner.add(wrong));
  }
  EXPECT_EQ(joiner.counters().refused, 6);
}

TEST(ChunkJoiner, AChunkThatContradictsTheOthersIsRefused) {
  Joiner joiner;
  EXPECT_FALSE(adds(joiner, 0, {0, 1, 2}));
  EXPECT_FALSE(joiner.add({kPeriod_us, 0, 3, 5}));
  EXPECT_EQ(joiner.counters().refused, 1);
  EXPECT_TRUE(adds(joiner, 0, {3}));
}

TEST(ChunkJoiner, DeliversInTheOrderOfTimeWhateverIsLostTwiceOrShuffled) {
  core::Rng rng(3);
  std::vector<Part> sent;
  for (int n = 0; n < 300; ++n) {
    for (int chunk = 0; chunk < 4; ++chunk) {
      if (rng.chance(0.05)) continue;
      sent.push_back(part(n, chunk));
      if (rng.chance(0.05)) sent.push_back(part(n, chunk));
    }
  }
  for (std::size_t i = 0; i + 3 < sent.size(); ++i) {  // neighbours mix, in blocks of four
    std::swap(sent[i], sent[i / 4 * 4 + static_cast<std::size_t>(rng.index(4))]);
  }
  Joiner joiner;
  std::int64_t last = 0;
  int delivered = 0;
  for (const Part& p : sent) {
    const auto whole = joiner.add(p);
    if (!whole) continue;
    EXPECT_GT(whole->front().utime, last);
    last = whole->front().utime;
    ++delivered;
  }
  EXPECT_GT(delivered, 200);  // 0.95⁴ of 300 are 244
  EXPECT_LT(delivered, 280);
}

}  // namespace
}  // namespace saker::flight
