#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "saker/lidar/bags/message_file.h"
#include "saker/lidar/file_bytes.h"

namespace saker::lidar {

/// An MCAP file (the specification of mcap.dev, version 0), chunks none, lz4 or zstd, messages of
/// ROS 1 or in CDR.
///
/// Records are read from the first to the last. The summary serves to know the topics beforehand;
/// where there is none or it does not fit, the file is read through once for them. Of a file that
/// is cut everything up to the cut is read, in the last chunk too.
class McapFile : public MessageFile {
 public:
  /// Throws Error when it cannot be opened or is no MCAP.
  explicit McapFile(const std::filesystem::path& file);

  [[nodiscard]] const std::vector<Topic>& topics() const override { return topics_.all(); }
  [[nodiscard]] std::optional<Message> next() override;
  [[nodiscard]] std::string amiss() const override { return amiss_; }
  [[nodiscard]] Time begin() const override { return begin_; }
  [[nodiscard]] Time end() const override { return end_; }

 private:
  struct Record {
    int op = 0;
    std::uint64_t at = 0;  // of the content
    std::uint64_t size = 0;
  };

  std::optional<Record> next_head();
  bool read_summary();
  void read_through();
  void rewind();
  void take_schema(ByteView content);
  void take_channel(ByteView content);
  void take_statistics(ByteView content);
  std::optional<Message> message_of(ByteView content);
  void open_chunk(const Record& record);
  std::optional<Message> next_in_chunk();
  void note(const std::string& text);

  std::filesystem::path path_;
  FileBytes file_;
  TopicList topics_;
  std::map<std::uint16_t, std::string> schemas_;   // names of types
  std::map<std::uint16_t, std::size_t> channels_;  // to topics
  std::uint64_t at_ = 0;                           // of the next record of the file
  std::vector<std::uint8_t> head_, packed_, chunk_;
  std::size_t chunk_at_ = 0;
  Time begin_ = 0, end_ = 0;
  bool over_ = false;
  bool quiet_ = false;  // while the file is read for its topics
  std::string amiss_;
};

}  // namespace saker::lidar
