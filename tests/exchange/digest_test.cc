#include "saker/exchange/digest.h"

#include <gtest/gtest.h>

#include "two_ends.h"

namespace saker::exchange {
namespace {

const StreamId kFlight{"R1", StreamKind::history, 1};

MemoryStore holding(const std::string& bytes) {
  MemoryStore store;
  EXPECT_TRUE(store.append(kFlight, bytes));
  return store;
}

std::uint32_t digest(const std::string& bytes, std::size_t count) {
  return PrefixDigest().of(holding(bytes), kFlight, count);
}

TEST(PrefixDigest, OfTheSameBeginningIsTheSameWhateverFollows) {
  const std::string bytes = some_bytes(5000, 1);
  for (const std::size_t count : {std::size_t{0}, std::size_t{1}, kChunkBytes, std::size_t{3333}}) {
    EXPECT_EQ(digest(bytes, count), digest(bytes.substr(0, count) + "other", count)) << count;
  }
}

TEST(PrefixDigest, OfOtherBytesIsAnother) {
  const std::string bytes = some_bytes(5000, 2);
  for (const std::size_t at : {0u, 1099u, 1100u, 2500u, 4999u}) {
    std::string changed = bytes;
    changed[at] = static_cast<char>(changed[at] ^ 1);
    EXPECT_NE(digest(changed, 5000), digest(bytes, 5000)) << at;
  }
}

TEST(PrefixDigest, OfALongerBeginningIsAnother) {
  const std::string zeros(3000, '\0');
  EXPECT_NE(digest(zeros, 2000), digest(zeros, 2001));
  EXPECT_NE(digest(zeros, 0), digest(zeros, 1));
}

TEST(PrefixDigest, IsTheSameInWhicheverOrderBeginningsAreAskedFor) {
  const MemoryStore store = holding(some_bytes(8000, 3));
  PrefixDigest walking;
  for (const std::size_t count : {10u, 1100u, 1101u, 4000u, 8000u, 500u, 2200u, 2200u}) {
    EXPECT_EQ(walking.of(store, kFlight, count), PrefixDigest().of(store, kFlight, count)) << count;
  }
}

TEST(PrefixDigest, FollowsAStreamThatGrows) {
  const std::string bytes = some_bytes(4000, 4);
  MemoryStore store = holding(bytes.substr(0, 1500));
  PrefixDigest growing;
  EXPECT_EQ(growing.of(store, kFlight, 1500), digest(bytes, 1500));
  ASSERT_TRUE(store.append(kFlight, bytes.substr(1500)));
  EXPECT_EQ(growing.of(store, kFlight, 4000), digest(bytes, 4000));
}

TEST(PrefixDigest, OfBytesThatAreNotHeldIsNoneOfThem) {
  const std::string bytes = some_bytes(2000, 5);
  EXPECT_NE(digest(bytes.substr(0, 1000), 2000), digest(bytes, 2000));
}

}  // namespace
}  // namespace saker::exchange
