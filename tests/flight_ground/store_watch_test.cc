#include "flight/ground/store_watch.h"

#include <gtest/gtest.h>

#include "flight_viewers/schema_check.h"
#include "flight_viewers/scratch_folder.h"
#include "saker/core/files.h"

namespace saker::flight::ground {
namespace {

using exchange::Kept;
using exchange::StreamKind;
using flight::testing::ScratchFolder;

class StoreWatches : public ::testing::Test {
 protected:
  StoreWatches() : file_((scratch_ / "base.db").string()), store_(file_, 100), news_(file_) {}

  void put(const exchange::StreamId& id, std::size_t offset, const std::string& bytes) {
    ASSERT_EQ(store_.put(id, offset, bytes), Kept::stored);
  }

  ScratchFolder scratch_;
  std::string file_;
  DatabaseStore store_;
  StoreNews news_;
};

TEST_F(StoreWatches, WhoToldWhatAndWhenIsSaid) {
  put({"R1", StreamKind::history, 2}, 0, "twelve bytes");
  store_.note_contact("R1", 1700000000500000);
  const auto news = news_.take(5);
  ASSERT_TRUE(news);
  const Json& robot = news->at("robots").at(0);
  EXPECT_EQ(robot.at("name"), "R1");
  EXPECT_EQ(robot.at("heard_s"), 1700000000.5);
  ASSERT_EQ(robot.at("streams").size(), 1u);
  EXPECT_EQ(robot.at("streams").at(0).dump(),
            R"({"kind":"history","version":2,"bytes":12,"gaps":0})");
}

TEST_F(StoreWatches, WhatDidNotChangeIsNoNews) {
  put({"R1", StreamKind::history, 1}, 0, "a");
  EXPECT_TRUE(news_.take(5));
  EXPECT_FALSE(news_.take(6));
}

TEST_F(StoreWatches, WhatGrowsIsSaidWithItsTimeAndTheRestWithoutOne) {
  put({"R1", StreamKind::history, 1}, 0, "a");
  put({"R2", StreamKind::history, 1}, 0, "b");
  static_cast<void>(news_.take(5));
  put({"R2", StreamKind::history, 1}, 1, "c");
  const auto news = news_.take(7.5);
  ASSERT_TRUE(news);
  EXPECT_FALSE(news->at("robots").at(0).at("streams").at(0).contains("came_s"));
  EXPECT_EQ(news->at("robots").at(1).at("streams").at(0).at("came_s"), 7.5);
}

TEST_F(StoreWatches, ANewStreamCameWhenItWasFirstSeen) {
  static_cast<void>(news_.take(5));
  put({"R3", StreamKind::prior_map, 1}, 0, "map");
  const auto news = news_.take(9);
  ASSERT_TRUE(news);
  EXPECT_EQ(news->at("robots").at(0).at("streams").at(0).at("came_s"), 9);
}

TEST_F(StoreWatches, NewsFollowTheirSchema) {
  put({"R1", StreamKind::history, 1}, 0, "a");
  put({"R1", StreamKind::uncertainty, 1}, 0, "b");
  store_.note_contact("R2", 1);
  const auto news = news_.take(5);
  ASSERT_TRUE(news);
  EXPECT_EQ(viewers::testing::against_schema(*news, Json::parse(store_schema()), "store"), "");
}

TEST(StoreNews, OfAStoreThatIsNotThereThereIsNone) {
  const ScratchFolder folder;
  EXPECT_FALSE(StoreNews((folder / "base.db").string()).take(1));
}

TEST(StoreNews, WhatIsNoStoreIsNoNews) {
  const ScratchFolder folder;
  core::write_file(folder / "base.db", "no database, whatever its name says");
  EXPECT_FALSE(StoreNews((folder / "base.db").string()).take(1));
}

TEST(StoreWatch, EndsAtOnceAndOffersNothingWithoutAStore) {
  const ScratchFolder folder;
  Hub hub({.mode = "live", .version = "1", .session = "s", .begin = {}, .end = {}});
  const auto begun = std::chrono::steady_clock::now();
  { const StoreWatch watch((folder / "base.db").string(), hub); }
  EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::seconds(1));
  EXPECT_FALSE(hub.wanted(1));
}

}  // namespace
}  // namespace saker::flight::ground
