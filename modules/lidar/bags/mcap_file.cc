#include "saker/lidar/bags/mcap_file.h"

#include <algorithm>

#include "saker/core/error.h"
#include "saker/lidar/bags/decompress.h"

namespace saker::lidar {
namespace {

constexpr std::string_view kMagic = "\x89MCAP0\r\n";
constexpr std::size_t kRecordHead = 9;  // a byte of what it is, eight of its length
constexpr std::size_t kFooterBytes = 20;

enum Op {
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kStatistics = 0x0B,
  kDataEnd = 0x0F
};

std::string text(Cursor& cursor) {
  return std::string(text_of(cursor.take(cursor.number<std::uint32_t>())));
}

Encoding encoding_of(const std::string& name) {
  if (name == "cdr") return Encoding::kCdr;
  if (name == "ros1") return Encoding::kRos1;
  return Encoding::kOther;
}

Time time_of(std::uint64_t nanoseconds) {
  return static_cast<Time>(std::min<std::uint64_t>(nanoseconds, INT64_MAX));
}

}  // namespace

McapFile::McapFile(const std::filesystem::path& file) : path_(file), file_(file) {
  file_.read(0, kMagic.size(), head_);
  if (text_of(head_) != kMagic) throw Error(file.string() + ": no MCAP file");
  quiet_ = true;
  if (!read_summary()) read_through();
  quiet_ = false;
  rewind();
}

void McapFile::rewind() {
  at_ = kMagic.size();
  over_ = false;
  chunk_.clear();
  chunk_at_ = 0;
}

void McapFile::note(const std::string& text) {
  if (!quiet_ && amiss_.empty()) amiss_ = text;
}

std::optional<McapFile::Record> McapFile::next_head() {
  if (at_ >= file_.size()) {
    note("the file ends without its end mark: it is cut");
    return std::nullopt;
  }
  file_.read(at_, kRecordHead, head_);
  Cursor cursor(head_);
  Record record;
  record.op = cursor.number<std::uint8_t>();
  record.size = cursor.number<std::uint64_t>();
  record.at = at_ + kRecordHead;
  if (!cursor.ok() || record.op == 0) {
    note("byte " + std::to_string(at_) + ": no record, the file is cut or damaged there");
    at_ = file_.size();
    return std::nullopt;
  }
  if (record.size > file_.size() - record.at) {
    note("cut in the record at byte " + std::to_string(at_));
    record.size = file_.size() - record.at;
    at_ = file_.size();
  } else {
    at_ = record.at + record.size;
  }
  return record;
}

/// The footer says where the summary begins: schemas, channels, statistics.
bool McapFile::read_summary() {
  const std::size_t end = kRecordHead + kFooterBytes + kMagic.size();
  if (file_.size() < kMagic.size() + end) return false;
  file_.read(file_.size() - end, end, head_);
  if (text_of(head_).substr(end - kMagic.size()) != kMagic || head_[0] != kFooter) return false;
  Cursor footer(ByteView(head_).subspan(kRecordHead));
  at_ = footer.number<std::uint64_t>();
  if (at_ < kMagic.size() || at_ >= file_.size()) return false;
  bool counted = false;
  std::vector<std::uint8_t> content;
  while (const auto record = next_head()) {
    if (record->op == kFooter) return counted && !channels_.empty();
    file_.read(record->at, record->size, content);
    if (record->op == kSchema) take_schema(content);
    if (record->op == kChannel) take_channel(content);
    if (record->op != kStatistics) continue;
    take_statistics(content);
    counted = true;
  }
  return false;
}

void McapFile::read_through() {
  topics_.clear_counts();
  begin_ = end_ = 0;
  rewind();
  while (const auto message = next()) {
    topics_.count(message->topic, 1);
    begin_ = begin_ == 0 ? message->received : std::min(begin_, message->received);
    end_ = std::max(end_, message->received);
  }
}

void McapFile::take_schema(ByteView content) {
  Cursor cursor(content);
  const auto id = cursor.number<std::uint16_t>();
  const std::string name = text(cursor);
  if (cursor.ok()) schemas_[id] = plain_type(name);
}

void McapFile::take_channel(ByteView content) {
  Cursor cursor(content);
  const auto id = cursor.number<std::uint16_t>();
  const auto schema = cursor.number<std::uint16_t>();
  const std::string name = text(cursor);
  const std::string encoding = text(cursor);
  if (!cursor.ok() || channels_.contains(id)) return;
  const auto type = schemas_.find(schema);
  channels_[id] =
      topics_.add({name, type == schemas_.end() ? "" : type->second, encoding_of(encoding), 0});
}

void McapFile::take_statistics(ByteView content) {
  Cursor cursor(content);
  cursor.skip(8 + 2 + 4 * 4);  // counts of messages, schemas, channels and the rest
  begin_ = time_of(cursor.number<std::uint64_t>());
  end_ = time_of(cursor.number<std::uint64_t>());
  Cursor counts(cursor.take(cursor.number<std::uint32_t>()));
  while (counts.left() >= 10) {
    const auto channel = channels_.find(counts.number<std::uint16_t>());
    const auto count = counts.number<std::uint64_t>();
    if (channel != channels_.end()) {
      topics_.count(channel->second, static_cast<long>(std::min<std::uint64_t>(count, 1U << 31)));
    }
  }
}

std::optional<Message> McapFile::message_of(ByteView content) {
  Cursor cursor(content);
  const auto channel = channels_.find(cursor.number<std::uint16_t>());
  cursor.skip(sizeof(std::uint32_t));  // its number
  const auto received = cursor.number<std::uint64_t>();
  cursor.skip(sizeof(std::uint64_t));  // when it was published
  if (!cursor.ok() || channel == channels_.end()) {
    note("a message without a channel");
    return std::nullopt;
  }
  return Message{channel->second, time_of(received), cursor.take(cursor.left())};
}

void McapFile::open_chunk(const Record& record) {
  file_.read(record.at, record.size, packed_);
  Cursor cursor(packed_);
  cursor.skip(2 * sizeof(std::uint64_t));  // first and last time
  const auto size = cursor.number<std::uint64_t>();
  cursor.skip(sizeof(std::uint32_t));  // of a check that decompression makes, too
  const std::string name = text(cursor);
  const auto packed_size = cursor.number<std::uint64_t>();
  const Compression compression = compression_of(name);
  const std::string where = "chunk at byte " + std::to_string(record.at);
  if (!cursor.ok() || compression == Compression::kUnknown || compression == Compression::kBz2 ||
      size > kLargestPiece) {
    return note(where +
                (cursor.ok() ? ": compression " + name + ", expected none, lz4 or zstd" : ": cut"));
  }
  chunk_at_ = 0;
  const ByteView bytes = cursor.take_at_most(packed_size);
  if (!decompress(compression, bytes, size, chunk_) || bytes.size() < packed_size) {
    note(where + ": cut or damaged");
  }
}

std::optional<Message> McapFile::next_in_chunk() {
  while (chunk_at_ < chunk_.size()) {
    Cursor cursor(ByteView(chunk_).subspan(chunk_at_));
    const int op = cursor.number<std::uint8_t>();
    const auto size = cursor.number<std::uint64_t>();
    const ByteView content = cursor.take(size);
    if (!cursor.ok()) {
      note("a record in a chunk is cut or damaged");
      break;
    }
    chunk_at_ += cursor.at();
    if (op == kSchema) take_schema(content);
    if (op == kChannel) take_channel(content);
    if (op != kMessage) continue;
    if (auto message = message_of(content)) return message;
  }
  chunk_.clear();
  chunk_at_ = 0;
  return std::nullopt;
}

std::optional<Message> McapFile::next() {
  while (!over_) {
    if (auto message = next_in_chunk()) return message;
    const auto record = next_head();
    if (!record || record->op == kDataEnd || record->op == kFooter) {
      over_ = true;
      break;
    }
    if (record->op == kChunk) {
      open_chunk(*record);
    } else if (record->op == kSchema || record->op == kChannel || record->op == kMessage) {
      file_.read(record->at, record->size, packed_);
      if (record->op == kSchema) take_schema(packed_);
      if (record->op == kChannel) take_channel(packed_);
      if (record->op != kMessage) continue;
      if (auto message = message_of(packed_)) return message;
    }
  }
  return std::nullopt;
}

}  // namespace saker::lidar
