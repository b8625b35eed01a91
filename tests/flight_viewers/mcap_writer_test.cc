#include "flight/viewers/mcap_writer.h"

#include <gtest/gtest.h>

#include <fstream>

#include "flight_viewers/scratch_folder.h"
#include "saker/lidar/bags/mcap_file.h"

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

}  // namespace
}  // namespace saker::flight::viewers
