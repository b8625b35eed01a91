#include "saker/lidar/bags/message_file.h"

#include <utility>

#include "saker/core/error.h"
#include "saker/core/one_line.h"
#include "saker/lidar/bags/mcap_file.h"
#include "saker/lidar/bags/ros1_bag.h"
#include "saker/lidar/bags/ros2_database.h"
#include "saker/lidar/bags/unpacked_file.h"

namespace saker::lidar {
namespace {

std::unique_ptr<MessageFile> open_plain(RecordingKind kind, const std::filesystem::path& file) {
  switch (kind) {
    case RecordingKind::kRos1Bag:
      return std::make_unique<Ros1Bag>(file);
    case RecordingKind::kMcap:
      return std::make_unique<McapFile>(file);
    case RecordingKind::kRos2Database:
      return std::make_unique<Ros2Database>(file);
    default:
      throw Error(file.string() + ": no file of messages, expected a ROS bag or MCAP");
  }
}

class MessageChain : public MessageFile {
 public:
  explicit MessageChain(const RecordingParts& parts) : kind_(parts.kind), files_(parts.files) {
    for (const auto& path : files_) {
      const auto file = open_messages(kind_, path);
      for (const Topic& topic : file->topics()) topics_.add(topic);
      if (begin_ == 0) begin_ = file->begin();
      if (file->end() != 0) end_ = file->end();
    }
  }

  [[nodiscard]] const std::vector<Topic>& topics() const override { return topics_.all(); }
  [[nodiscard]] Time begin() const override { return begin_; }
  [[nodiscard]] Time end() const override { return end_; }

  [[nodiscard]] std::optional<Message> next() override {
    while (true) {
      if (!open_) {
        if (next_ >= files_.size()) return std::nullopt;
        open_ = open_messages(kind_, files_[next_++]);
      }
      if (auto message = open_->next()) {
        Topic topic = open_->topics()[message->topic];
        topic.messages = 0;
        message->topic = topics_.add(topic);
        return message;
      }
      note(open_->amiss());
      open_.reset();
    }
  }

  [[nodiscard]] std::string amiss() const override { return amiss_; }

 private:
  void note(const std::string& text) {
    if (text.empty()) return;
    amiss_ += (amiss_.empty() ? "" : "; ") + files_[next_ - 1].filename().string() + ": " + text;
  }

  RecordingKind kind_;
  std::vector<std::filesystem::path> files_;
  TopicList topics_;
  std::unique_ptr<MessageFile> open_;
  std::size_t next_ = 0;
  Time begin_ = 0, end_ = 0;
  std::string amiss_;
};

}  // namespace

namespace {

/// A file that was packed as a whole.
class UnpackedMessages : public MessageFile {
 public:
  UnpackedMessages(RecordingKind kind, const std::filesystem::path& file)
      : unpacked_(file), file_(open_plain(kind, unpacked_.path())) {}

  [[nodiscard]] const std::vector<Topic>& topics() const override { return file_->topics(); }
  [[nodiscard]] std::optional<Message> next() override { return file_->next(); }
  [[nodiscard]] Time begin() const override { return file_->begin(); }
  [[nodiscard]] Time end() const override { return file_->end(); }
  [[nodiscard]] std::string amiss() const override {
    const std::string amiss = file_->amiss();
    return amiss.empty() && unpacked_.cut() ? "cut or damaged" : amiss;
  }

 private:
  UnpackedFile unpacked_;
  std::unique_ptr<MessageFile> file_;
};

}  // namespace

std::unique_ptr<MessageFile> open_messages(RecordingKind kind, const std::filesystem::path& file) {
  if (is_zstd(file)) return std::make_unique<UnpackedMessages>(kind, file);
  return open_plain(kind, file);
}
std::unique_ptr<MessageFile> open_messages(const RecordingParts& parts) {
  if (parts.files.size() == 1) return open_messages(parts.kind, parts.files.front());
  return std::make_unique<MessageChain>(parts);
}

std::string plain_type(const std::string& type) {
  const auto at = type.find("/msg/");
  return at == std::string::npos ? type : type.substr(0, at) + type.substr(at + 4);
}

std::size_t TopicList::add(Topic topic) {
  topic.name = one_line(topic.name);
  topic.type = one_line(topic.type);
  for (std::size_t i = 0; i < topics_.size(); ++i) {
    if (topics_[i].name == topic.name && topics_[i].type == topic.type) {
      topics_[i].messages += topic.messages;
      return i;
    }
  }
  topics_.push_back(std::move(topic));
  return topics_.size() - 1;
}

void TopicList::clear_counts() {
  for (Topic& topic : topics_) topic.messages = 0;
}

}  // namespace saker::lidar
