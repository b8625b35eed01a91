#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "saker/lidar/bags/message_file.h"

struct sqlite3;
struct sqlite3_stmt;

namespace saker::lidar {

/// The SQLite database of a ROS 2 bag (rosbag2_storage_sqlite3: tables topics and messages), by
/// time; messages that are compressed one by one (zstd) are unpacked.
class Ros2Database : public MessageFile {
 public:
  /// Throws Error when it cannot be opened or has not those tables.
  explicit Ros2Database(const std::filesystem::path& file);
  ~Ros2Database() override;
  Ros2Database(const Ros2Database&) = delete;
  Ros2Database& operator=(const Ros2Database&) = delete;

  [[nodiscard]] const std::vector<Topic>& topics() const override { return topics_.all(); }
  [[nodiscard]] std::optional<Message> next() override;
  [[nodiscard]] std::string amiss() const override { return amiss_; }
  [[nodiscard]] Time begin() const override { return begin_; }
  [[nodiscard]] Time end() const override { return end_; }

 private:
  void prepare(const char* query);
  void read_topics();
  [[nodiscard]] std::string text(int column) const;

  std::filesystem::path path_;
  sqlite3* database_ = nullptr;
  sqlite3_stmt* statement_ = nullptr;
  TopicList topics_;
  std::map<std::int64_t, std::size_t> ids_;  // to topics
  std::vector<std::uint8_t> unpacked_;
  Time begin_ = 0, end_ = 0;
  bool over_ = false;
  std::string amiss_;
};

}  // namespace saker::lidar
