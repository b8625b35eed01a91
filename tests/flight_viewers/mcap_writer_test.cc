#include "flight/viewers/mcap_writer.h"

#include <gtest/gtest.h>

#include "flight_viewers/scratch_folder.h"
#include "saker/core/error.h"
#include "saker/core/files.h"
#include "saker/lidar/bags/mcap_file.h"
#include "saker/objects/checksum.h"

namespace saker::flight::viewers {
namespace {

using flight::testing::ScratchFolder;

McapWriter::Channel channel(const std::string& topic) {
  return {.topic = topic,
          .encoding = "json",
          .schema_name = "saker.Made",
          .schema_encoding = "jsonschema",
          .schema = R"({"type":"object"})"};
}

std::string text_of(const lidar::Message& message) {
  return {message.bytes.begin(), message.bytes.end()};
}

TEST(McapWriter, OurReaderReadsWhatWasWritten) {
  const ScratchFolder folder;
  {
    McapWriter writer(folder / "a.mcap");
    const auto a = writer.add(channel("/R1/a")), b = writer.add(channel("/R1/b"));
    writer.write(a, 1000, R"({"x":1})");
    writer.write(b, 2000, R"({"x":2})");
    writer.write(a, 3000, R"({"x":3})");
    writer.finish();
  }
  lidar::McapFile file(folder / "a.mcap");
  ASSERT_EQ(file.topics().size(), 2u);
  EXPECT_EQ(file.topics()[0].name, "/R1/a");
  EXPECT_EQ(file.topics()[0].messages, 2);
  EXPECT_EQ(file.begin(), 1000);
  EXPECT_EQ(file.end(), 3000);
  const char* const expected[] = {R"({"x":1})", R"({"x":2})", R"({"x":3})"};
  for (int i = 0; i < 3; ++i) {
    const auto message = file.next();
    ASSERT_TRUE(message);
    EXPECT_EQ(text_of(*message), expected[i]);
    EXPECT_EQ(message->received, 1000 * (i + 1));
  }
  EXPECT_FALSE(file.next());
  EXPECT_EQ(file.amiss(), "");
}

TEST(McapWriter, ManyChunksAreOneFile) {
  const ScratchFolder folder;
  constexpr int kCount = 40;
  {
    McapWriter writer(folder / "a.mcap");
    const auto id = writer.add(channel("/R1/a"));
    for (int i = 0; i < kCount; ++i)
      writer.write(id, i, std::string(200000, static_cast<char>('a' + i % 26)));
    writer.finish();
    EXPECT_EQ(writer.messages(), static_cast<std::uint64_t>(kCount));
  }
  EXPECT_LT(std::filesystem::file_size(folder / "a.mcap"), 200000u);  // compressed
  lidar::McapFile file(folder / "a.mcap");
  EXPECT_EQ(file.topics().at(0).messages, kCount);  // by the summary
  for (int i = 0; i < kCount; ++i) {
    const auto message = file.next();
    ASSERT_TRUE(message) << i;
    EXPECT_EQ(text_of(*message).front(), static_cast<char>('a' + i % 26));
  }
  EXPECT_FALSE(file.next());
  EXPECT_EQ(file.amiss(), "");
}

TEST(McapWriter, AFileThatWasNotFinishedIsNotThere) {
  const ScratchFolder folder;
  {
    McapWriter writer(folder / "a.mcap");
    writer.write(writer.add(channel("/R1/a")), 1, "{}");
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(McapWriter, AnEmptyRecordingIsAFileToo) {
  const ScratchFolder folder;
  McapWriter writer(folder / "a.mcap");
  writer.finish();
  lidar::McapFile file(folder / "a.mcap");
  EXPECT_TRUE(file.topics().empty());
  EXPECT_FALSE(file.next());
}

/// A file as the specification has it, read by this test alone: what stands where.
class Records {
 public:
  struct Record {
    int op;
    std::uint64_t at;  ///< of its first byte in the file
    std::string content;
  };

  explicit Records(const std::string& bytes) {
    EXPECT_EQ(bytes.substr(0, 8), std::string("\x89MCAP0\r\n", 8));
    EXPECT_EQ(bytes.substr(bytes.size() - 8), std::string("\x89MCAP0\r\n", 8));
    for (std::uint64_t at = 8; at + 8 < bytes.size();) {
      const std::uint64_t size = number(bytes, at + 1, 8);
      records_.push_back({static_cast<unsigned char>(bytes[at]), at, bytes.substr(at + 9, size)});
      at += 9 + size;
    }
  }

  static std::uint64_t number(const std::string& bytes, std::size_t at, int size) {
    std::uint64_t value = 0;
    for (int i = 0; i < size; ++i)
      value |= std::uint64_t{static_cast<unsigned char>(bytes.at(at + static_cast<std::size_t>(i)))}
               << (8 * i);
    return value;
  }
  [[nodiscard]] std::vector<Record> of(int op) const {
    std::vector<Record> found;
    for (const Record& record : records_) {
      if (record.op == op) found.push_back(record);
    }
    return found;
  }
  [[nodiscard]] std::vector<int> ops() const {
    std::vector<int> ops;
    for (const Record& record : records_) ops.push_back(record.op);
    return ops;
  }

 private:
  std::vector<Record> records_;
};

/// Three messages of two channels with one schema.
std::string small_file(const ScratchFolder& folder) {
  McapWriter writer(folder / "a.mcap");
  const auto a = writer.add(channel("/R1/a")), b = writer.add(channel("/R1/b"));
  writer.write(a, 5000, "{}");
  writer.write(b, 2000, "{}");
  writer.write(a, 3000, "{}");
  writer.finish();
  return core::read_file(folder / "a.mcap");
}

TEST(McapWriter, RecordsStandInTheOrderOfTheSpecification) {
  const ScratchFolder folder;
  // Header, chunk, two indices, end of the data; schema, two channels, statistics, index of the
  // chunk, four offsets of the summary, footer.
  EXPECT_EQ(Records(small_file(folder)).ops(),
            (std::vector<int>{1, 6, 7, 7, 15, 3, 4, 4, 11, 8, 14, 14, 14, 14, 2}));
}

TEST(McapWriter, AChunksIndexSaysWhereItIsAndWhatItHolds) {
  const ScratchFolder folder;
  const Records file(small_file(folder));
  const auto chunk = file.of(6).at(0), index = file.of(8).at(0);
  EXPECT_EQ(Records::number(index.content, 0, 8), 2000u);  // earliest
  EXPECT_EQ(Records::number(index.content, 8, 8), 5000u);  // latest
  EXPECT_EQ(Records::number(index.content, 16, 8), chunk.at);
  EXPECT_EQ(Records::number(index.content, 24, 8), 9 + chunk.content.size());
  EXPECT_EQ(Records::number(chunk.content, 0, 8), 2000u);
  EXPECT_EQ(Records::number(chunk.content, 8, 8), 5000u);
}

TEST(McapWriter, AMessagesIndexHasItsTimesInTheOrderOfTheFile) {
  const ScratchFolder folder;
  const auto indices = Records(small_file(folder)).of(7);
  ASSERT_EQ(indices.size(), 2u);
  const std::string& a = indices[0].content;
  EXPECT_EQ(Records::number(a, 0, 2), 1u);   // the channel
  EXPECT_EQ(Records::number(a, 2, 4), 32u);  // bytes: two entries
  EXPECT_EQ(Records::number(a, 6, 8), 5000u);
  EXPECT_EQ(Records::number(a, 22, 8), 3000u);
  EXPECT_LT(Records::number(a, 14, 8), Records::number(a, 30, 8));
}

TEST(McapWriter, TheFootersChecksumIsThatOfTheSummary) {
  const ScratchFolder folder;
  const std::string bytes = small_file(folder);
  const auto footer = Records(bytes).of(2).at(0);
  const std::uint64_t summary = Records::number(footer.content, 0, 8);
  const std::uint64_t end = footer.at + 9 + 16;  // up to the checksum itself
  EXPECT_EQ(Records::number(footer.content, 16, 4),
            objects::checksum(std::string_view(bytes).substr(summary, end - summary)));
  EXPECT_EQ(Records(bytes).of(3).at(0).at, summary);  // which begins with the schema
}

TEST(McapWriter, TheOffsetsOfTheSummaryAreThoseOfItsGroups) {
  const ScratchFolder folder;
  const Records file(small_file(folder));
  for (const auto& offset : file.of(14)) {
    const int op = static_cast<unsigned char>(offset.content[0]);
    const auto group = file.of(op);
    EXPECT_EQ(Records::number(offset.content, 1, 8), group.at(0).at) << op;
    const auto& last = group.back();
    EXPECT_EQ(Records::number(offset.content, 9, 8),
              last.at + 9 + last.content.size() - group[0].at)
        << op;
  }
}

TEST(McapWriter, TheStatisticsCountWhatThereIs) {
  const ScratchFolder folder;
  const std::string s = Records(small_file(folder)).of(11).at(0).content;
  EXPECT_EQ(Records::number(s, 0, 8), 3u);   // messages
  EXPECT_EQ(Records::number(s, 8, 2), 1u);   // schemas
  EXPECT_EQ(Records::number(s, 10, 4), 2u);  // channels
  EXPECT_EQ(Records::number(s, 22, 4), 1u);  // chunks
  EXPECT_EQ(Records::number(s, 26, 8), 2000u);
  EXPECT_EQ(Records::number(s, 34, 8), 5000u);
}

TEST(McapWriter, ATimeBeforeTheBeginningOfTimesIsTheBeginning) {
  const ScratchFolder folder;
  McapWriter writer(folder / "a.mcap");
  writer.write(writer.add(channel("/R1/a")), -5, "{}");
  writer.finish();
  EXPECT_EQ(lidar::McapFile(folder / "a.mcap").begin(), 0);
}

TEST(McapWriter, ChannelsOfOtherSchemasAreTold) {
  const ScratchFolder folder;
  McapWriter writer(folder / "a.mcap");
  auto other = channel("/R1/b");
  other.schema = "{}";
  EXPECT_EQ(writer.add(channel("/R1/a")), 1);
  EXPECT_EQ(writer.add(other), 2);
  EXPECT_EQ(writer.add(channel("/R1/c")), 3);
  writer.finish();
  EXPECT_EQ(Records(core::read_file(folder / "a.mcap")).of(3).size(), 2u);
}

TEST(McapWriter, AChannelThatWasNotAddedIsAnError) {
  const ScratchFolder folder;
  McapWriter writer(folder / "a.mcap");
  EXPECT_ANY_THROW(writer.write(7, 1, "{}"));
}

TEST(McapWriter, AFolderThatIsNotThereIsAnError) {
  const ScratchFolder folder;
  EXPECT_THROW(McapWriter(folder / "none/a.mcap"), Error);
}

TEST(McapWriter, AnEarlierFileOfThatNameStaysUntilTheNewOneIsWhole) {
  const ScratchFolder folder;
  core::write_file(folder / "a.mcap", "earlier");
  {
    McapWriter writer(folder / "a.mcap");
    writer.write(writer.add(channel("/R1/a")), 1, "{}");
    EXPECT_EQ(core::read_file(folder / "a.mcap"), "earlier");
  }
  EXPECT_EQ(core::read_file(folder / "a.mcap"), "earlier");
}

TEST(McapWriter, AMessageOfNoBytesIsOne) {
  const ScratchFolder folder;
  McapWriter writer(folder / "a.mcap");
  writer.write(writer.add(channel("/R1/a")), 1, "");
  writer.finish();
  lidar::McapFile file(folder / "a.mcap");
  const auto message = file.next();
  ASSERT_TRUE(message);
  EXPECT_EQ(text_of(*message), "");
}

}  // namespace
}  // namespace saker::flight::viewers
