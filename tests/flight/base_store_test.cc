#include <gtest/gtest.h>
#include <sqlite3.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "flight/base_station/store.h"
#include "saker/core/error.h"
#include "saker/core/rng.h"

namespace saker::flight {
namespace {

using exchange::kChunkBytes;
using exchange::Kept;
using exchange::StreamId;
using exchange::StreamKind;

const StreamId kFlight{"R1", StreamKind::history, 1};

std::string made_bytes(std::size_t size, std::uint64_t seed = 1) {
  core::Rng rng(seed);
  std::string bytes(size, '\0');
  for (char& byte : bytes) byte = static_cast<char>(rng.uniform(0, 256));
  return bytes;
}

class AStore : public testing::Test {
 protected:
  void SetUp() override {
    std::string form = (std::filesystem::temp_directory_path() / "saker_store_XXXXXX").string();
    ASSERT_NE(mkdtemp(form.data()), nullptr);
    folder = form;
    file = folder / "base.db";
  }
  void TearDown() override { std::filesystem::remove_all(folder); }

  [[nodiscard]] DatabaseStore opened(int most_mb = 100) const {
    return DatabaseStore(file.string(), most_mb);
  }

  /// Runs SQL on the file, as another program would.
  void alter(const std::string& sql) const {
    sqlite3* database = nullptr;
    ASSERT_EQ(sqlite3_open(file.c_str(), &database), SQLITE_OK);
    ASSERT_EQ(sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK)
        << sqlite3_errmsg(database);
    sqlite3_close(database);
  }

  [[nodiscard]] std::string refusal() const {
    try {
      (void)opened();
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }

  std::filesystem::path folder, file;
};

TEST_F(AStore, GivesBackAfterARestartWhatWasPut) {
  const std::string bytes = made_bytes(5 * kChunkBytes + 300);
  {
    DatabaseStore store = opened();
    EXPECT_TRUE(store.append(kFlight, bytes));
  }
  const DatabaseStore store = opened();
  EXPECT_EQ(store.size(kFlight), bytes.size());
  EXPECT_TRUE(store.bytes(kFlight) == bytes);
  EXPECT_EQ(store.damaged(), 0);
}

TEST_F(AStore, GrowsTheLastChunkByteForByte) {
  const std::string bytes = made_bytes(3 * kChunkBytes);
  {
    DatabaseStore store = opened();
    for (std::size_t at = 0; at < bytes.size(); at += 150)
      EXPECT_TRUE(store.append(kFlight, std::string_view(bytes).substr(at, 150)));
  }
  EXPECT_TRUE(opened().bytes(kFlight) == bytes);
}

TEST_F(AStore, KeepsChunksBeyondAGapOverARestart) {
  const std::string bytes = made_bytes(4 * kChunkBytes);
  const auto chunk = [&](std::size_t k) {
    return std::string_view(bytes).substr(k * kChunkBytes, kChunkBytes);
  };
  {
    DatabaseStore store = opened();
    EXPECT_EQ(store.put(kFlight, 0, chunk(0)), Kept::stored);
    EXPECT_EQ(store.put(kFlight, 3 * kChunkBytes, chunk(3)), Kept::stored);
  }
  DatabaseStore store = opened();
  EXPECT_EQ(store.size(kFlight), kChunkBytes);
  EXPECT_TRUE(store.chunk(kFlight, 3) == chunk(3));
  EXPECT_EQ(store.put(kFlight, 1 * kChunkBytes, chunk(1)), Kept::stored);
  EXPECT_EQ(store.put(kFlight, 2 * kChunkBytes, chunk(2)), Kept::stored);
  EXPECT_TRUE(store.bytes(kFlight) == bytes);
}

TEST_F(AStore, HoldsStreamsApart) {
  const std::vector<StreamId> ids = {{"R1", StreamKind::history, 1},
                                     {"R1", StreamKind::history, 2},
                                     {"R1", StreamKind::prior_map, 1},
                                     {"R2", StreamKind::history, 1}};
  {
    DatabaseStore store = opened();
    for (std::size_t i = 0; i < ids.size(); ++i)
      EXPECT_TRUE(store.append(ids[i], made_bytes(2000 + 100 * i, i)));
  }
  const DatabaseStore store = opened();
  EXPECT_EQ(store.extents().size(), ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i)
    EXPECT_TRUE(store.bytes(ids[i]) == made_bytes(2000 + 100 * i, i));
}

TEST_F(AStore, RefusesChunksAtItsCeilingAndLosesNothing) {
  const std::string bytes = made_bytes(1'300'000);
  std::size_t held = 0;
  {
    DatabaseStore store = opened(1);
    EXPECT_FALSE(store.append(kFlight, bytes));
    EXPECT_TRUE(store.full());
    held = store.size(kFlight);
    EXPECT_GT(held, 700'000u);
    EXPECT_LT(held, 1'000'000u);
    EXPECT_TRUE(store.bytes(kFlight) == bytes.substr(0, held));
  }
  DatabaseStore store = opened(10);
  EXPECT_TRUE(store.bytes(kFlight) == bytes.substr(0, held));
  EXPECT_TRUE(store.append(kFlight, std::string_view(bytes).substr(held)));
  EXPECT_FALSE(store.full());
  EXPECT_TRUE(store.bytes(kFlight) == bytes);
}

TEST_F(AStore, ADamagedChunkIsAskedForAgain) {
  const std::string bytes = made_bytes(4 * kChunkBytes);
  {
    DatabaseStore store = opened();
    EXPECT_TRUE(store.append(kFlight, bytes));
  }
  alter("UPDATE chunks SET bytes=zeroblob(1100) WHERE place & 65535 = 1");
  DatabaseStore store = opened();
  EXPECT_EQ(store.damaged(), 1);
  EXPECT_EQ(store.size(kFlight), kChunkBytes);
  EXPECT_EQ(
      store.put(kFlight, kChunkBytes, std::string_view(bytes).substr(kChunkBytes, kChunkBytes)),
      Kept::stored);
  EXPECT_TRUE(store.bytes(kFlight) == bytes);
}

TEST_F(AStore, AChunkMovedToAnotherPlaceIsDamaged) {
  {
    DatabaseStore store = opened();
    EXPECT_TRUE(store.append(kFlight, made_bytes(2 * kChunkBytes)));
  }
  alter("UPDATE streams SET robot='R2'");
  EXPECT_EQ(opened().damaged(), 2);
}

TEST_F(AStore, ARowThatNamesNoStreamIsDamagedAndNothingElse) {
  for (const char* wrong : {"kind=9", "kind=-1", "version=4294967297", "robot='r 1'"}) {
    std::filesystem::remove(file);
    {
      DatabaseStore store = opened();
      EXPECT_TRUE(store.append({"R2", StreamKind::history, 1}, made_bytes(100)));
      EXPECT_TRUE(store.append(kFlight, made_bytes(100)));
    }
    alter(std::string("UPDATE streams SET ") + wrong + " WHERE robot='R2'");
    const DatabaseStore store = opened();
    EXPECT_EQ(store.damaged(), 1) << wrong;
    EXPECT_EQ(store.size(kFlight), 100u) << wrong;
    EXPECT_EQ(read_report(file.string()).robots.size(), 1u) << wrong;
  }
}

TEST_F(AStore, OfANewerVersionIsRefused) {
  { (void)opened(); }
  alter("PRAGMA user_version=2");
  EXPECT_EQ(refusal(), "store " + file.string() +
                           " has version 2, expected 1: it was written by a newer saker-base");
}

TEST_F(AStore, OfAnotherProgramIsRefused) {
  alter("CREATE TABLE sheep(name TEXT)");
  EXPECT_NE(refusal().find("belongs to another program"), std::string::npos) << refusal();
}

TEST_F(AStore, WhatIsNoDatabaseIsRefused) {
  std::ofstream(file) << made_bytes(10000);
  EXPECT_NE(refusal().find("not a database"), std::string::npos) << refusal();
}

TEST_F(AStore, DamagedPagesAreRefusedWithTheCommandThatMends) {
  {
    DatabaseStore store = opened();
    EXPECT_TRUE(store.append(kFlight, made_bytes(200 * kChunkBytes)));
  }
  std::fstream bytes(file, std::ios::in | std::ios::out | std::ios::binary);
  bytes.seekp(20 * 4096);
  bytes << std::string(4096, '\xff');
  bytes.close();
  EXPECT_NE(refusal().find("is damaged"), std::string::npos) << refusal();
  EXPECT_NE(refusal().find(".recover"), std::string::npos) << refusal();
}

TEST_F(AStore, InAFolderThatIsNotThereIsRefused) {
  file = folder / "nowhere" / "base.db";
  EXPECT_NE(refusal().find("cannot be opened"), std::string::npos) << refusal();
}

TEST_F(AStore, ReportsRobotsStreamsAndContactsWhileItIsWritten) {
  DatabaseStore store = opened();
  EXPECT_TRUE(store.append(kFlight, made_bytes(3000)));
  EXPECT_TRUE(store.append({"R1", StreamKind::history, 2}, made_bytes(10)));
  EXPECT_EQ(store.put({"R2", StreamKind::history, 1}, 2 * kChunkBytes, made_bytes(5)),
            Kept::stored);
  store.note_contact("R1", 1'000'000);
  store.note_contact("R1", 2'000'000);
  store.note_contact("R3", 3'000'000);
  const StoreReport report = read_report(file.string());
  ASSERT_EQ(report.robots.size(), 3u);
  EXPECT_EQ(report.robots[0].name, "R1");
  EXPECT_EQ(report.robots[0].heard_utime, 2'000'000);
  ASSERT_EQ(report.robots[0].streams.size(), 2u);
  EXPECT_EQ(report.robots[0].streams[0].bytes, 3000u);
  EXPECT_EQ(report.robots[0].streams[1].bytes, 10u);
  EXPECT_EQ(report.robots[1].heard_utime, std::nullopt);
  EXPECT_EQ(report.robots[1].streams[0].bytes, 0u);
  EXPECT_EQ(report.robots[1].streams[0].gaps, 1);
  EXPECT_EQ(report.robots[2].name, "R3");
  EXPECT_TRUE(report.robots[2].streams.empty());
}

TEST_F(AStore, AReportOfNoStoreIsRefused) { EXPECT_THROW((void)read_report(file.string()), Error); }

}  // namespace
}  // namespace saker::flight
