#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "saker/lidar/bags/message_file.h"
#include "saker/lidar/file_bytes.h"

namespace saker::lidar {

/// A ROS 1 bag ("Bags/Format/2.0" of the ROS wiki), chunks none, lz4 or bz2.
///
/// Records are read from the first to the last. The index serves to know the topics beforehand;
/// where it is missing (a bag that was not closed) or does not fit, the file is read through once
/// for them. Of a file that is cut everything up to the cut is read, in the last chunk too.
class Ros1Bag : public MessageFile {
 public:
  /// Throws Error when it cannot be opened or is no such bag.
  explicit Ros1Bag(const std::filesystem::path& file);

  [[nodiscard]] const std::vector<Topic>& topics() const override { return topics_.all(); }
  [[nodiscard]] std::optional<Message> next() override;
  [[nodiscard]] std::string amiss() const override { return amiss_; }
  [[nodiscard]] Time begin() const override { return begin_; }
  [[nodiscard]] Time end() const override { return end_; }

 private:
  struct Record {
    int op = 0;
    std::map<std::string, ByteView, std::less<>> fields;
    ByteView data;
  };
  /// A record's head of the file itself; the data stay where they are.
  struct FileRecord {
    Record record;
    std::uint64_t data_at = 0;
    std::uint64_t data_size = 0;
  };

  static bool parse_head(ByteView head, Record& record);
  static bool parse(Cursor& cursor, Record& record);
  std::optional<FileRecord> next_head();
  bool read_index();
  void read_through();
  void rewind();
  void take_connection(const Record& record);
  void take_chunk_info(const Record& record);
  bool open_chunk(const FileRecord& head);
  std::optional<Message> message_of(const Record& record);
  std::optional<Message> next_in_chunk();
  void note(const std::string& text);

  std::filesystem::path path_;
  FileBytes file_;
  TopicList topics_;
  std::map<std::uint32_t, std::size_t> connections_;  // to topics
  std::uint64_t at_ = 0;                              // of the next record of the file
  std::vector<std::uint8_t> head_, packed_, chunk_;
  std::size_t chunk_at_ = 0;
  Time begin_ = 0, end_ = 0;
  bool quiet_ = false;  // while the file is read for its topics
  std::string amiss_;
};

}  // namespace saker::lidar
