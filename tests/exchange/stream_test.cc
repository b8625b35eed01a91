#include "saker/exchange/stream.h"

#include <gtest/gtest.h>

#include "saker/core/rng.h"
#include "saker/exchange/exchange.h"
#include "saker/exchange/journal_store.h"
#include "saker/exchange/packed_history.h"

namespace saker::exchange {
namespace {

TEST(Extent, ChunksThatCloseTheGapBelongToTheBeginning) {
  Extent held;
  held.add(1, kChunkBytes);
  held.add(2, 10);
  EXPECT_EQ(held.contiguous, 0u);
  held.add(0, kChunkBytes);
  EXPECT_EQ(held.contiguous, 2 * kChunkBytes + 10);
  EXPECT_TRUE(held.beyond.empty());
}

TEST(Extent, AShorterBeginningOfAChunkTakesNothingAway) {
  Extent held;
  held.add(0, 100);
  held.add(0, 40);
  held.add(3, 50);
  held.add(3, 20);
  EXPECT_EQ(held.contiguous, 100u);
  EXPECT_EQ(held.bytes_of(3), 50u);
}

/// The bytes of each of the first chunks.
std::vector<std::size_t> bytes_of_each(const Extent& held, int chunks) {
  std::vector<std::size_t> bytes;
  for (int k = 0; k < chunks; ++k) bytes.push_back(held.bytes_of(k));
  return bytes;
}

TEST(Extent, MergedHoldsOfEachChunkTheLongerBeginning) {
  constexpr int kChunks = 12;
  core::Rng rng(1);
  for (int round = 0; round < 500; ++round) {
    Extent a, b;
    for (int i = 0; i < 10; ++i) {
      const std::size_t bytes = rng.chance(0.7) ? kChunkBytes : rng.index(kChunkBytes);
      (rng.chance(0.5) ? a : b).add(rng.index(kChunks), bytes);
    }
    std::vector<std::size_t> longer = bytes_of_each(a, kChunks);
    const std::vector<std::size_t> other = bytes_of_each(b, kChunks);
    for (int k = 0; k < kChunks; ++k) longer[k] = std::max(longer[k], other[k]);
    a.merge(b);
    ASSERT_EQ(bytes_of_each(a, kChunks), longer);
  }
}

TEST(StreamId, NamesAreOfCapitalsAndDigits) {
  EXPECT_TRUE(is_name("R1"));
  for (const char* name : {"", "r1", "R 1", "R1/", "ABCDEFGHIJKLMNOPQ"}) {
    EXPECT_FALSE(is_name(name)) << name;
  }
}

}  // namespace
}  // namespace saker::exchange
