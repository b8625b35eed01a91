#include <gtest/gtest.h>

#include "made_bag.h"
#include "made_sensor.h"
#include "saker/core/error.h"
#include "saker/core/rng.h"
#include "saker/lidar/bags/mcap_file.h"
#include "saker/lidar/bags/ros1_bag.h"
#include "saker/lidar/bags/ros2_database.h"

namespace saker::lidar {
namespace {

using testing::BagOptions;
using testing::MadeMessage;
using testing::TemporaryFolder;
using testing::write_bytes;
using Bytes = std::vector<std::uint8_t>;

/// How a file of messages is written and opened.
struct Format {
  const char* name;
  RecordingKind kind;
  Encoding encoding;
  std::vector<const char*> compressions;
};

const Format kFormats[] = {
    {"ros1", RecordingKind::kRos1Bag, Encoding::kRos1, {"none", "lz4", "bz2"}},
    {"mcap", RecordingKind::kMcap, Encoding::kCdr, {"none", "lz4", "zstd"}}};

Bytes made(const Format& format, const std::vector<MadeMessage>& messages,
           const BagOptions& options) {
  return format.kind == RecordingKind::kRos1Bag
             ? testing::made_ros1_bag(messages, options)
             : testing::made_mcap(messages, format.encoding, options);
}

/// The messages of a file, as they were made.
std::vector<MadeMessage> read(MessageFile& file) {
  std::vector<MadeMessage> messages;
  while (const auto m = file.next()) {
    const Topic& topic = file.topics().at(m->topic);
    messages.push_back({topic.name, topic.type, m->received, {m->bytes.begin(), m->bytes.end()}});
  }
  return messages;
}

void expect_equal(const std::vector<MadeMessage>& a, const std::vector<MadeMessage>& b,
                  const std::string& what) {
  ASSERT_EQ(a.size(), b.size()) << what;
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].topic, b[i].topic) << what;
    EXPECT_EQ(a[i].type, b[i].type) << what;
    EXPECT_EQ(a[i].received, b[i].received) << what;
    EXPECT_EQ(a[i].bytes, b[i].bytes) << what;
  }
}

TEST(MessageFiles, GiveEveryMessageWithEveryCompressionWithAndWithoutIndex) {
  for (const Format& format : kFormats) {
    const auto messages = testing::made_drive(3, format.encoding);
    for (const char* compression : format.compressions) {
      for (const bool index : {true, false}) {
        const TemporaryFolder folder;
        write_bytes(folder / "drive", made(format, messages, {compression, 7, index, true}));
        const auto file = open_messages(format.kind, folder / "drive");
        const std::string what = std::string(format.name) + " " + compression;
        expect_equal(read(*file), messages, what);
        EXPECT_EQ(file->amiss(), "") << what;
        EXPECT_EQ(file->begin(), messages.front().received) << what;
        EXPECT_EQ(file->end(), messages.back().received) << what;
      }
    }
  }
}

TEST(MessageFiles, KnowTheirTopicsBeforeTheyAreRead) {
  for (const Format& format : kFormats) {
    for (const bool index : {true, false}) {
      const TemporaryFolder folder;
      write_bytes(folder / "drive",
                  made(format, testing::made_drive(3, format.encoding), {"none", 7, index, true}));
      const auto file = open_messages(format.kind, folder / "drive");
      std::map<std::string, long> counts;
      for (const Topic& topic : file->topics()) counts[topic.name] = topic.messages;
      EXPECT_EQ(counts, (std::map<std::string, long>{{"/imu/data", 30}, {"/points", 3}}))
          << format.name;
    }
  }
}

TEST(McapFile, ReadsMessagesOutsideOfChunks) {
  const TemporaryFolder folder;
  const auto messages = testing::made_drive(2, Encoding::kRos1);
  write_bytes(folder / "a.mcap",
              testing::made_mcap(messages, Encoding::kRos1, {"none", 7, true, false}));
  McapFile file(folder / "a.mcap");
  expect_equal(read(file), messages, "without chunks");
  EXPECT_EQ(file.topics().front().encoding, Encoding::kRos1);
}

/// A few short messages: cut at every byte in a moment.
std::vector<MadeMessage> short_messages() {
  std::vector<MadeMessage> messages;
  for (int i = 0; i < 9; ++i) {
    messages.push_back({i % 3 == 0 ? "/a" : "/b", "std_msgs/Int8", 1'000'000'000LL + i,
                        Bytes(3, static_cast<std::uint8_t>(i))});
  }
  return messages;
}

TEST(MessageFiles, CutAnywhereGiveWhatIsBeforeTheCut) {
  for (const Format& format : kFormats) {
    const auto messages = short_messages();
    for (const char* compression : format.compressions) {
      const TemporaryFolder folder;
      const Bytes whole = made(format, messages, {compression, 4, true, true});
      std::size_t before = 0;
      for (std::size_t size = 13; size < whole.size(); size += 3) {
        write_bytes(folder / "cut",
                    {whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)});
        const auto file = open_messages(format.kind, folder / "cut");
        const auto found = read(*file);
        EXPECT_GE(found.size() + 4, before) << size;  // of a chunk that is packed, nothing perhaps
        ASSERT_LE(found.size(), messages.size());
        for (std::size_t i = 0; i < found.size(); ++i) EXPECT_EQ(found[i].bytes, messages[i].bytes);
        before = found.size();
      }
      EXPECT_EQ(before, messages.size()) << format.name << " " << compression;
    }
  }
}

TEST(MessageFiles, SayThatTheyAreCut) {
  for (const Format& format : kFormats) {
    const TemporaryFolder folder;
    const Bytes whole = made(format, short_messages(), {"none", 4, false, true});
    write_bytes(folder / "cut", {whole.begin(), whole.begin() + whole.size() / 2});
    const auto file = open_messages(format.kind, folder / "cut");
    EXPECT_LT(read(*file).size(), 9U);
    EXPECT_NE(file->amiss(), "") << format.name;
  }
}

TEST(MessageFiles, DamagedBytesNeverThrowPastTheOpening) {
  for (const Format& format : kFormats) {
    const TemporaryFolder folder;
    core::Rng rng(11);
    const Bytes whole = made(format, short_messages(), {"none", 4, true, true});
    for (int trial = 0; trial < 400; ++trial) {
      Bytes damaged = whole;
      for (int i = 0; i < 1 + trial % 4; ++i) {
        damaged[8 + static_cast<std::size_t>(rng.index(static_cast<int>(whole.size()) - 8))] =
            static_cast<std::uint8_t>(rng.index(256));
      }
      write_bytes(folder / "damaged", damaged);
      try {
        const auto file = open_messages(format.kind, folder / "damaged");
        EXPECT_LE(read(*file).size(), 1000U);
      } catch (const Error&) {
        // Its first bytes were hit.
      }
    }
  }
}

TEST(MessageFiles, OtherFilesAreRefused) {
  const TemporaryFolder folder;
  write_bytes(folder / "text", Bytes(100, 'a'));
  EXPECT_THROW(Ros1Bag(folder / "text"), Error);
  EXPECT_THROW(McapFile(folder / "text"), Error);
  EXPECT_THROW(Ros2Database(folder / "text"), Error);
  EXPECT_THROW(Ros1Bag(folder / "missing"), Error);
}

TEST(Ros2Database, GivesEveryMessageByTimeAlsoCompressedOnes) {
  const TemporaryFolder folder;
  auto messages = testing::made_drive(2, Encoding::kCdr);
  testing::write_ros2_database(messages, folder / "a.db3");
  Ros2Database plain(folder / "a.db3");
  expect_equal(read(plain), messages, "plain");
  EXPECT_EQ(plain.topics().front().encoding, Encoding::kCdr);
  auto packed = messages;
  for (MadeMessage& m : packed) m.bytes = testing::compressed("zstd", m.bytes);
  testing::write_ros2_database(packed, folder / "b.db3");
  Ros2Database unpacked(folder / "b.db3");
  expect_equal(read(unpacked), messages, "each packed");
}

TEST(MessageChain, FilesThatFollowOneAnotherAreOne) {
  const TemporaryFolder folder;
  const auto messages = testing::made_drive(4, Encoding::kRos1);
  RecordingParts parts{RecordingKind::kRos1Bag, {}};
  for (int part = 0; part < 2; ++part) {
    const std::vector<MadeMessage> half(messages.begin() + part * 22,
                                        messages.begin() + (part + 1) * 22);
    parts.files.push_back(folder / ("drive_" + std::to_string(part) + ".bag"));
    write_bytes(parts.files.back(), testing::made_ros1_bag(half));
  }
  const auto file = open_messages(parts);
  expect_equal(read(*file), messages, "chain");
  EXPECT_EQ(file->begin(), messages.front().received);
  EXPECT_EQ(file->end(), messages.back().received);
}

}  // namespace
}  // namespace saker::lidar
