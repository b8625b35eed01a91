#include "saker/lidar/bags/ros2_database.h"

#include <sqlite3.h>

#include <algorithm>

#include "saker/core/error.h"
#include "saker/lidar/bags/decompress.h"

namespace saker::lidar {
namespace {

constexpr std::uint32_t kZstdMagic = 0xFD2FB528;

}  // namespace

Ros2Database::Ros2Database(const std::filesystem::path& file) : path_(file) {
  if (sqlite3_open_v2(file.c_str(), &database_, SQLITE_OPEN_READONLY, nullptr) != SQLITE_OK) {
    const std::string why = sqlite3_errmsg(database_);
    sqlite3_close(database_);
    throw Error("cannot read " + file.string() + ": " + why);
  }
  try {
    read_topics();
    prepare("SELECT topic_id, timestamp, data FROM messages ORDER BY timestamp");
  } catch (...) {
    sqlite3_finalize(statement_);
    sqlite3_close(database_);
    throw;
  }
}

Ros2Database::~Ros2Database() {
  sqlite3_finalize(statement_);
  sqlite3_close(database_);
}

void Ros2Database::prepare(const char* query) {
  sqlite3_finalize(statement_);
  statement_ = nullptr;
  if (sqlite3_prepare_v2(database_, query, -1, &statement_, nullptr) != SQLITE_OK) {
    throw Error(path_.string() + ": " + sqlite3_errmsg(database_) +
                ", expected a ROS 2 bag's tables topics and messages");
  }
}

std::string Ros2Database::text(int column) const {
  const auto* characters = sqlite3_column_text(statement_, column);
  return characters == nullptr ? "" : reinterpret_cast<const char*>(characters);
}

void Ros2Database::read_topics() {
  prepare("SELECT id, name, type, serialization_format FROM topics ORDER BY id");
  while (sqlite3_step(statement_) == SQLITE_ROW) {
    const Encoding encoding = text(3) == "cdr" ? Encoding::kCdr : Encoding::kOther;
    ids_[sqlite3_column_int64(statement_, 0)] =
        topics_.add({text(1), plain_type(text(2)), encoding, 0});
  }
  prepare(
      "SELECT topic_id, COUNT(*), MIN(timestamp), MAX(timestamp) FROM messages GROUP BY topic_id");
  while (sqlite3_step(statement_) == SQLITE_ROW) {
    const auto topic = ids_.find(sqlite3_column_int64(statement_, 0));
    if (topic == ids_.end()) continue;
    topics_.count(topic->second, static_cast<long>(sqlite3_column_int64(statement_, 1)));
    const Time first = sqlite3_column_int64(statement_, 2);
    begin_ = begin_ == 0 ? first : std::min(begin_, first);
    end_ = std::max<Time>(end_, sqlite3_column_int64(statement_, 3));
  }
}

std::optional<Message> Ros2Database::next() {
  while (!over_) {
    const int status = sqlite3_step(statement_);
    if (status != SQLITE_ROW) {
      over_ = true;
      if (status != SQLITE_DONE) amiss_ = sqlite3_errmsg(database_);
      break;
    }
    const auto topic = ids_.find(sqlite3_column_int64(statement_, 0));
    if (topic == ids_.end()) continue;
    const auto size = static_cast<std::size_t>(sqlite3_column_bytes(statement_, 2));
    ByteView bytes(static_cast<const std::uint8_t*>(sqlite3_column_blob(statement_, 2)), size);
    if (Cursor(bytes).number<std::uint32_t>() == kZstdMagic) {
      if (!decompress(Compression::kZstd, bytes, kLargestPiece, unpacked_)) {
        amiss_ = "a compressed message is damaged";
        continue;
      }
      bytes = unpacked_;
    }
    return Message{topic->second, sqlite3_column_int64(statement_, 1), bytes};
  }
  return std::nullopt;
}

}  // namespace saker::lidar
