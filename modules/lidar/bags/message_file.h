#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "saker/core/time.h"
#include "saker/lidar/cursor.h"
#include "saker/lidar/recording_kind.h"

/// Files of messages by topic: ROS 1 bags, MCAP, ROS 2 databases.
namespace saker::lidar {

/// How a message's fields are put into bytes.
enum class Encoding { kRos1, kCdr, kOther };

struct Topic {
  std::string name;
  std::string type;  ///< "sensor_msgs/PointCloud2", the same for ROS 1 and 2
  Encoding encoding = Encoding::kOther;
  long messages =
      0;  ///< as far as the file says without being read through; else as far as counted

  bool operator==(const Topic&) const = default;
};

struct Message {
  std::size_t topic = 0;  ///< index into `topics()`
  Time received = 0;
  ByteView bytes;  ///< until the next call
};

class MessageFile {
 public:
  virtual ~MessageFile() = default;

  /// All of the file, whatever was read so far.
  [[nodiscard]] virtual const std::vector<Topic>& topics() const = 0;

  /// In the order of the file. Nothing at its end.
  [[nodiscard]] virtual std::optional<Message> next() = 0;

  /// Why reading ended before the file's end, or what was left out; empty when all was well.
  [[nodiscard]] virtual std::string amiss() const = 0;

  /// First and last time of reception, as far as the file says; 0 where it does not.
  [[nodiscard]] virtual Time begin() const = 0;
  [[nodiscard]] virtual Time end() const = 0;
};

/// Throws Error when the file cannot be read or is none of these.
[[nodiscard]] std::unique_ptr<MessageFile> open_messages(RecordingKind kind,
                                                         const std::filesystem::path& file);

/// Files that follow one another, as one.
[[nodiscard]] std::unique_ptr<MessageFile> open_messages(const RecordingParts& parts);

/// "sensor_msgs/msg/PointCloud2" is "sensor_msgs/PointCloud2".
[[nodiscard]] std::string plain_type(const std::string& type);

/// Topics by name and type, in the order in which they come.
class TopicList {
 public:
  /// \return its index
  std::size_t add(Topic topic);

  [[nodiscard]] const std::vector<Topic>& all() const { return topics_; }
  void count(std::size_t topic, long messages) { topics_[topic].messages += messages; }
  void clear_counts();

 private:
  std::vector<Topic> topics_;
};

}  // namespace saker::lidar
