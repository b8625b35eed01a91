#include "saker/exchange/message.h"

#include <gtest/gtest.h>

#include "two_ends.h"

namespace saker::exchange {
namespace {

const StreamId kLongest{"ABCDEFGHIJKLMNOP", StreamKind::uncertainty, 0xFFFFFFFF};

Extent some_extent(core::Rng& rng) {
  Extent held;
  held.add(0, 1 + static_cast<std::size_t>(rng.index(kChunkBytes)));
  for (int i = rng.index(30); i > 0; --i) held.add(rng.index(kMostBeyond), kChunkBytes);
  const int last = kMostBeyond + 1 + rng.index(3);
  if (rng.chance(0.3)) held.add(last, 1 + static_cast<std::size_t>(rng.index(kChunkBytes)));
  return held;
}

HoldingsMessage some_holdings(core::Rng& rng) {
  HoldingsMessage message{.asks = rng.chance(0.5), .round = 7, .answers = 300};
  for (int i = rng.index(5); i > 0; --i) {
    Holding line;
    line.id = {"R1", StreamKind::history, static_cast<std::uint32_t>(i)};
    line.held = some_extent(rng);
    line.digest = 0xDEADBEEF;
    line.refused = rng.chance(0.2);
    message.lines.push_back(line);
  }
  return message;
}

TEST(Message, HoldingsAreReadAsTheyWereWritten) {
  core::Rng rng(1);
  for (int round = 0; round < 300; ++round) {
    const HoldingsMessage before = some_holdings(rng);
    const auto after = std::get<HoldingsMessage>(message_of(to_bytes(before)).value());
    EXPECT_EQ(after.asks, before.asks);
    EXPECT_EQ(after.round, 7u);
    EXPECT_EQ(after.answers, 300u);
    ASSERT_EQ(after.lines.size(), before.lines.size());
    for (std::size_t i = 0; i < after.lines.size(); ++i) {
      EXPECT_EQ(after.lines[i].id, before.lines[i].id);
      EXPECT_EQ(after.lines[i].digest, before.lines[i].digest);
      EXPECT_EQ(after.lines[i].refused, before.lines[i].refused);
      EXPECT_EQ(after.lines[i].held.contiguous, before.lines[i].held.contiguous);
      for (const auto& [chunk, bytes] : after.lines[i].held.beyond) {
        EXPECT_EQ(bytes, before.lines[i].held.bytes_of(chunk)) << chunk;
      }
    }
  }
}

TEST(Message, AChunkThatIsPartialBeyondTheGapCountsOnlyWhereItIsTheLast) {
  HoldingsMessage message;
  Extent held;
  held.add(0, 5);
  held.add(2, 70);
  held.add(4, 90);
  message.lines.emplace_back();
  message.lines[0].id = {"R1", StreamKind::history, 1};
  message.lines[0].held = held;
  const auto after = std::get<HoldingsMessage>(message_of(to_bytes(message)).value());
  EXPECT_EQ(after.lines[0].held.beyond, (std::map<int, std::size_t>{{4, 90}}));
}

TEST(Message, TheLongestChunkFits) {
  ChunkMessage message;
  message.id = kLongest;
  message.offset = (kMostChunks - 1) * kChunkBytes;
  message.bytes = std::string(kChunkBytes, 'x');
  const std::string bytes = to_bytes(message);
  EXPECT_LE(bytes.size(), kLongestMessage);
  const auto after = std::get<ChunkMessage>(message_of(bytes).value());
  EXPECT_EQ(after.id, kLongest);
  EXPECT_EQ(after.offset, message.offset);
  EXPECT_EQ(after.bytes, message.bytes);
}

TEST(Message, ChunksThatCrossAChunksEndAreNone) {
  ChunkMessage message;
  message.id = kLongest;
  message.offset = 10;
  message.bytes = std::string(kChunkBytes - 9, 'x');
  EXPECT_FALSE(message_of(to_bytes(message)));
  message.bytes.pop_back();
  EXPECT_TRUE(message_of(to_bytes(message)));
}

TEST(Message, AnyBytesAreReadOrRefused) {
  core::Rng rng(2);
  int read = 0;
  for (int round = 0; round < 50'000; ++round) {
    std::string bytes = to_bytes(some_holdings(rng));
    for (int i = rng.index(3); i >= 0; --i) {
      bytes[rng.index(static_cast<int>(bytes.size()))] = static_cast<char>(rng.index(256));
    }
    const auto message = message_of(bytes.substr(0, rng.index(static_cast<int>(bytes.size()) + 1)));
    if (!message) continue;
    ++read;
    const auto* holdings = std::get_if<HoldingsMessage>(&*message);
    if (holdings == nullptr) continue;
    for (const Holding& line : holdings->lines) {
      ASSERT_TRUE(is_name(line.id.robot));
      ASSERT_LE(line.held.contiguous, kMostChunks * kChunkBytes);
    }
  }
  EXPECT_GT(read, 100);
  EXPECT_FALSE(message_of(""));
}

/// What only a team's member could send, who is out of his mind: neither a fault nor memory.
TEST(Peer, AnyMessagesOfTheTeamLeaveItWhole) {
  MemoryStore store;
  ASSERT_TRUE(store.append({"R1", StreamKind::history, 1}, some_bytes(20'000, 1)));
  Peer peer({}, Role::answers, store);
  core::Rng rng(3);
  for (int i = 0; i < 20'000; ++i) {
    std::string bytes = to_bytes(some_holdings(rng));
    if (rng.chance(0.5)) {
      ChunkMessage chunk;
      chunk.id = {"R2", StreamKind::history, 1};
      chunk.offset = static_cast<std::size_t>(rng.index(100)) * kChunkBytes;
      chunk.bytes = some_bytes(1 + static_cast<std::size_t>(rng.index(kChunkBytes)), i);
      bytes = to_bytes(chunk);
    }
    if (rng.chance(0.3)) bytes[rng.index(static_cast<int>(bytes.size()))] ^= 0x41;
    const Time now = i * from_seconds(0.01);
    peer.receive(now, bytes);
    while (const auto message = peer.next(now, 0)) ASSERT_LE(message->size(), kLongestMessage);
  }
  EXPECT_GT(peer.counters().malformed, 100);
}

}  // namespace
}  // namespace saker::exchange
