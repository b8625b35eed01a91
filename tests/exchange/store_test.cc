#include "saker/exchange/store.h"

#include <gtest/gtest.h>

#include "saker/core/error.h"
#include "saker/core/files.h"
#include "saker/exchange/bytes.h"
#include "two_ends.h"

namespace saker::exchange {
namespace {

const StreamId kFlight{"R1", StreamKind::history, 1};

TEST(Store, AppendsAcrossChunks) {
  MemoryStore store;
  const std::string bytes = some_bytes(5000, 1);
  ASSERT_TRUE(store.append(kFlight, bytes.substr(0, 700)));
  ASSERT_TRUE(store.append(kFlight, bytes.substr(700)));
  EXPECT_EQ(store.size(kFlight), 5000u);
  EXPECT_EQ(store.bytes(kFlight), bytes);
  EXPECT_EQ(store.chunk(kFlight, 1), bytes.substr(kChunkBytes, kChunkBytes));
  EXPECT_EQ(store.chunk(kFlight, 5), "");
}

TEST(Store, ChunksInAnyOrderGiveTheSameBytes) {
  const std::string bytes = some_bytes(20 * kChunkBytes + 77, 2);
  MemoryStore store;
  core::Rng rng(1);
  for (int i = 0; i < 2000; ++i) {
    const std::size_t offset = rng.index(21) * kChunkBytes;
    store.put(kFlight, offset, std::string_view(bytes).substr(offset, kChunkBytes));
  }
  EXPECT_EQ(store.bytes(kFlight), bytes);
}

TEST(Store, SaysWhatBecameOfBytes) {
  MemoryStore store;
  EXPECT_EQ(store.put(kFlight, 0, "abcd"), Kept::stored);
  EXPECT_EQ(store.put(kFlight, 2, "cd"), Kept::repeated);
  EXPECT_EQ(store.put(kFlight, 2, "cdef"), Kept::stored);
  EXPECT_EQ(store.put(kFlight, 7, "x"), Kept::gap);
  EXPECT_EQ(store.put(kFlight, kChunkBytes - 1, "xy"), Kept::refused);
  EXPECT_EQ(store.put(kFlight, kMostChunks * kChunkBytes, "x"), Kept::refused);
  EXPECT_EQ(store.put({"r1", StreamKind::history, 1}, 0, "x"), Kept::refused);
  EXPECT_EQ(store.bytes(kFlight), "abcdef");
}

TEST(Store, TakesNoMoreStreamsThanItsCeiling) {
  MemoryStore store;
  for (std::uint32_t v = 0; v < Store::kMostStreams; ++v) {
    ASSERT_EQ(store.put({"R1", StreamKind::history, v}, 0, "x"), Kept::stored);
  }
  EXPECT_EQ(store.put({"R2", StreamKind::history, 1}, 0, "x"), Kept::refused);
}

TEST(Store, AFileIsANewVersionOnlyWhereItChanged) {
  MemoryStore store;
  EXPECT_EQ(publish(store, "R1", StreamKind::uncertainty, "models"), 1u);
  EXPECT_EQ(publish(store, "R1", StreamKind::uncertainty, "models"), 1u);
  EXPECT_EQ(publish(store, "R2", StreamKind::uncertainty, "others"), 1u);
  EXPECT_EQ(publish(store, "R1", StreamKind::uncertainty, "better models"), 2u);
  EXPECT_EQ(store.bytes({"R1", StreamKind::uncertainty, 1}), "models");
  EXPECT_EQ(newest_version(store, "R1", StreamKind::uncertainty), 2u);
  EXPECT_EQ(newest_version(store, "R1", StreamKind::history), 0u);
}

TEST(JournalStore, HoldsAfterARestartWhatItHeldBefore) {
  const auto file = test_folder() / "journal";
  const std::string bytes = some_bytes(10'000, 1);
  std::map<StreamId, Extent> extents;
  {
    JournalStore store(file);
    ASSERT_TRUE(store.append(kFlight, bytes.substr(0, 2500)));
    store.put(kFlight, 4 * kChunkBytes, std::string_view(bytes).substr(4 * kChunkBytes, 900));
    extents = store.extents();
  }
  JournalStore store(file);
  EXPECT_EQ(store.extents(), extents);
  EXPECT_EQ(store.bytes(kFlight), bytes.substr(0, 2500));
}

TEST(JournalStore, ACutEndLosesTheCutRecordOnlyAndIsWrittenOver) {
  const auto folder = test_folder();
  const std::string bytes = some_bytes(1500, 1), more = some_bytes(700, 2);
  {
    JournalStore store(folder / "whole");
    for (int i = 0; i < 15; ++i) {
      ASSERT_TRUE(store.append(kFlight, std::string_view(bytes).substr(100 * i, 100)));
    }
  }
  const std::string whole = core::read_file(folder / "whole");
  for (std::size_t size = 0; size <= whole.size(); size += 13) {
    core::write_file(folder / "cut", whole.substr(0, size));
    std::size_t held = 0;
    {
      JournalStore store(folder / "cut");
      held = store.size(kFlight);
      ASSERT_EQ(store.bytes(kFlight), bytes.substr(0, held));
      ASSERT_EQ(held % 100, 0u);
      ASSERT_TRUE(store.append(kFlight, more));
    }
    JournalStore again(folder / "cut");
    ASSERT_EQ(again.bytes(kFlight), bytes.substr(0, held) + more);
  }
}

/// A journal of one record, its check sum as of a whole one.
std::string journal_of(std::uint64_t from, std::string_view bytes) {
  ByteWriter body, out;
  body.text("R1");
  for (int i = 0; i < 3; ++i) body.byte(i == 1 ? 1 : 0);  // kind, version, chunk
  body.varint(from);
  body.text(bytes);
  std::uint32_t sum = 1, sums = 0;
  for (const char byte : body.bytes()) {
    sum = (sum + static_cast<std::uint8_t>(byte)) % 65521;
    sums = (sums + sum) % 65521;
  }
  out.raw("SAKERSTREAMS1\n");
  out.text(body.bytes());
  out.fixed(sums << 16 | sum);
  return out.bytes();
}

TEST(JournalStore, ARecordThatDoesNotBeginWhereTheOneBeforeEndsIsNoRecord) {
  const auto file = test_folder() / "made";
  core::write_file(file, journal_of(0, "abc"));
  EXPECT_EQ(JournalStore(file).bytes(kFlight), "abc");
  for (const std::uint64_t from :
       {std::uint64_t{1}, std::uint64_t{kChunkBytes}, ~std::uint64_t{0}}) {
    core::write_file(file, journal_of(from, "abc"));
    EXPECT_TRUE(JournalStore(file).extents().empty()) << from;
  }
  core::write_file(file, journal_of(0, ""));
  EXPECT_TRUE(JournalStore(file).extents().empty());
}

TEST(JournalStore, AnotherFileIsRefused) {
  const auto file = test_folder() / "text";
  core::write_file(file, "something else that is longer than the magic");
  EXPECT_THROW(JournalStore{file}, Error);
}

}  // namespace
}  // namespace saker::exchange
