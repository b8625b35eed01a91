#include "saker/lidar/bags/ros1_bag.h"

#include <algorithm>

#include "saker/core/error.h"
#include "saker/lidar/bags/decompress.h"

namespace saker::lidar {
namespace {

constexpr std::string_view kMagic = "#ROSBAG V2.0\n";
constexpr std::size_t kLargestHead = 1 << 20;

enum Op { kMessage = 2, kBagHead = 3, kIndex = 4, kChunk = 5, kChunkInfo = 6, kConnection = 7 };

template <class T, class Fields>
std::optional<T> number(const Fields& fields, std::string_view name) {
  const auto found = fields.find(name);
  if (found == fields.end() || found->second.size() != sizeof(T)) return std::nullopt;
  return Cursor(found->second).number<T>();
}

template <class Fields>
std::string text(const Fields& fields, std::string_view name) {
  const auto found = fields.find(name);
  return found == fields.end() ? "" : std::string(text_of(found->second));
}

Time time_of(std::uint64_t field) {
  const auto seconds = static_cast<std::uint32_t>(field);
  const auto rest = static_cast<std::uint32_t>(field >> 32);
  return static_cast<Time>(seconds) * kNanosecondsPerSecond + rest;
}

}  // namespace

Ros1Bag::Ros1Bag(const std::filesystem::path& file) : path_(file), file_(file) {
  file_.read(0, kMagic.size(), head_);
  if (text_of(head_) != kMagic) {
    throw Error(file.string() + ": no ROS bag of version 2.0, expected it to begin #ROSBAG V2.0");
  }
  quiet_ = true;
  if (!read_index()) read_through();
  quiet_ = false;
  rewind();
}

void Ros1Bag::rewind() {
  at_ = kMagic.size();
  chunk_.clear();
  chunk_at_ = 0;
}

void Ros1Bag::note(const std::string& text) {
  if (!quiet_ && amiss_.empty()) amiss_ = text;
}

/// Fields of a head: a length and NAME=VALUE, one after the other.
bool Ros1Bag::parse_head(ByteView head, Record& record) {
  record = {};
  Cursor cursor(head);
  while (cursor.left() > 0) {
    const ByteView field = cursor.take(cursor.number<std::uint32_t>());
    const auto equals = std::find(field.begin(), field.end(), std::uint8_t{'='});
    if (!cursor.ok() || equals == field.end()) return false;
    const auto name = static_cast<std::size_t>(equals - field.begin());
    record.fields.emplace(text_of(field.first(name)), field.subspan(name + 1));
  }
  const auto op = number<std::uint8_t>(record.fields, "op");
  record.op = op.value_or(0);
  return op.has_value();
}

bool Ros1Bag::parse(Cursor& cursor, Record& record) {
  const ByteView head = cursor.take(cursor.number<std::uint32_t>());
  const ByteView data = cursor.take(cursor.number<std::uint32_t>());
  if (!cursor.ok() || !parse_head(head, record)) return false;
  record.data = data;
  return true;
}

std::optional<Ros1Bag::FileRecord> Ros1Bag::next_head() {
  if (at_ >= file_.size()) return std::nullopt;
  FileRecord found;
  std::vector<std::uint8_t> size;
  const auto length_at = [&](std::uint64_t at) {
    file_.read(at, sizeof(std::uint32_t), size);
    return Cursor(size).number<std::uint32_t>();
  };
  const std::uint32_t head_size = length_at(at_);
  file_.read(at_ + 4, std::min<std::size_t>(head_size, kLargestHead), head_);
  if (head_.size() != head_size || !parse_head(head_, found.record)) {
    note("byte " + std::to_string(at_) + ": no record, the file is cut or damaged there");
    at_ = file_.size();
    return std::nullopt;
  }
  found.data_size = length_at(at_ + 4 + head_size);
  found.data_at = at_ + 8 + head_size;
  at_ = found.data_at + found.data_size;
  if (at_ > file_.size()) {
    note("cut in the record at byte " + std::to_string(found.data_at));
    found.data_size = file_.size() - std::min<std::uint64_t>(file_.size(), found.data_at);
  }
  return found;
}

bool Ros1Bag::read_index() {
  at_ = kMagic.size();
  const auto head = next_head();
  if (!head || head->record.op != kBagHead) return false;
  const auto index = number<std::uint64_t>(head->record.fields, "index_pos");
  const auto count = number<std::uint32_t>(head->record.fields, "conn_count");
  if (!index || !count || *index < at_ || *index >= file_.size()) return false;
  at_ = *index;
  while (auto record = next_head()) {
    if (record->record.op != kConnection && record->record.op != kChunkInfo) return false;
    file_.read(record->data_at, record->data_size, packed_);
    record->record.data = packed_;
    if (record->record.op == kConnection) take_connection(record->record);
    if (record->record.op == kChunkInfo) take_chunk_info(record->record);
  }
  return connections_.size() >= *count;
}

void Ros1Bag::read_through() {
  connections_.clear();
  topics_.clear_counts();
  begin_ = end_ = 0;
  rewind();
  while (const auto message = next()) {
    topics_.count(message->topic, 1);
    begin_ = begin_ == 0 ? message->received : std::min(begin_, message->received);
    end_ = std::max(end_, message->received);
  }
}

void Ros1Bag::take_connection(const Record& record) {
  const auto number_of = number<std::uint32_t>(record.fields, "conn");
  Record head;
  // The data are a head of their own, without an op.
  (void)parse_head(record.data, head);
  if (!number_of || connections_.contains(*number_of)) return;
  connections_[*number_of] = topics_.add(
      {text(record.fields, "topic"), plain_type(text(head.fields, "type")), Encoding::kRos1, 0});
}

void Ros1Bag::take_chunk_info(const Record& record) {
  const auto first = number<std::uint64_t>(record.fields, "start_time");
  const auto last = number<std::uint64_t>(record.fields, "end_time");
  if (first && (begin_ == 0 || time_of(*first) < begin_)) begin_ = time_of(*first);
  if (last) end_ = std::max(end_, time_of(*last));
  Cursor counts(record.data);
  while (counts.left() >= 8) {
    const auto connection = connections_.find(counts.number<std::uint32_t>());
    const auto count = counts.number<std::uint32_t>();
    if (connection != connections_.end()) topics_.count(connection->second, count);
  }
}

bool Ros1Bag::open_chunk(const FileRecord& head) {
  const std::string name = text(head.record.fields, "compression");
  const Compression compression = compression_of(name);
  const auto size = number<std::uint32_t>(head.record.fields, "size");
  if (compression == Compression::kUnknown || !size || *size > kLargestPiece) {
    note("chunk at byte " + std::to_string(head.data_at) + ": compression " + name +
         ", expected none, lz4 or bz2");
    return false;
  }
  file_.read(head.data_at, head.data_size, packed_);
  chunk_at_ = 0;
  if (compression == Compression::kNone) {
    chunk_.swap(packed_);
  } else if (!decompress(compression, packed_, *size, chunk_)) {
    note("chunk at byte " + std::to_string(head.data_at) + ": cut or damaged");
  }
  return true;
}

std::optional<Message> Ros1Bag::message_of(const Record& record) {
  const auto number_of = number<std::uint32_t>(record.fields, "conn");
  const auto time = number<std::uint64_t>(record.fields, "time");
  const auto topic = connections_.find(number_of.value_or(0));
  if (!number_of || !time || topic == connections_.end()) {
    note("a message without a connection");
    return std::nullopt;
  }
  return Message{topic->second, time_of(*time), record.data};
}

std::optional<Message> Ros1Bag::next_in_chunk() {
  Record record;
  while (chunk_at_ < chunk_.size()) {
    Cursor cursor(ByteView(chunk_).subspan(chunk_at_));
    if (!parse(cursor, record)) {
      note("a record in a chunk is cut or damaged");
      break;
    }
    chunk_at_ += cursor.at();
    if (record.op == kConnection) take_connection(record);
    if (record.op != kMessage) continue;
    if (auto message = message_of(record)) return message;
  }
  chunk_.clear();
  chunk_at_ = 0;
  return std::nullopt;
}

std::optional<Message> Ros1Bag::next() {
  while (true) {
    if (auto message = next_in_chunk()) return message;
    auto head = next_head();
    if (!head) return std::nullopt;
    const int op = head->record.op;
    if (op == kChunk) {
      (void)open_chunk(*head);
    } else if (op == kMessage || op == kConnection) {
      file_.read(head->data_at, head->data_size, packed_);
      head->record.data = packed_;
      if (op == kConnection) take_connection(head->record);
      if (op != kMessage) continue;
      if (auto message = message_of(head->record)) return message;
    }
  }
}

}  // namespace saker::lidar
