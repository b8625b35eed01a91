#include "flight/base_station/store.h"

#include <sodium.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <optional>

#include "saker/core/error.h"

namespace saker::flight {
namespace {

using exchange::StreamId;
using exchange::StreamKind;

constexpr std::int64_t kApplication = 0x53414B42;  // "SAKB", in the header of the file
constexpr std::int64_t kVersion = 1;               // of the tables
constexpr int kPagesOfLog = 256;                   // 1 MB, then it is moved into the tables
constexpr std::int64_t kBytesOfAMegabyte = 1'000'000;

// A chunk's place is its stream's id · 65536 + its number: rows of one stream lie side by side, and
// a page takes three of them.
static_assert(exchange::kMostChunks == 65536);
constexpr const char* kTables = R"(
CREATE TABLE streams(id INTEGER PRIMARY KEY, robot TEXT NOT NULL, kind INTEGER NOT NULL,
                     version INTEGER NOT NULL, UNIQUE(robot, kind, version));
CREATE TABLE chunks(place INTEGER PRIMARY KEY, digest BLOB NOT NULL, bytes BLOB NOT NULL);
CREATE TABLE contacts(robot TEXT PRIMARY KEY, utime INTEGER NOT NULL) WITHOUT ROWID;
)";
constexpr const char* kAllChunks = R"(
SELECT robot, kind, version, place & 65535, digest, bytes
FROM chunks JOIN streams ON streams.id = place >> 16 ORDER BY place
)";
const std::string kPlace =
    "((SELECT id FROM streams WHERE robot=?1 AND kind=?2 AND version=?3) * 65536 + ?4)";

using Bytes = std::span<const std::uint8_t>;
using Digest = std::array<std::uint8_t, crypto_generichash_BYTES_MIN>;

Bytes bytes_of(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

/// Of a chunk's bytes and of where they belong.
Digest digest_of(const StreamId& id, int chunk, Bytes bytes) {
  const std::string place = to_string(id) + "/" + std::to_string(chunk);
  crypto_generichash_state state;
  Digest result{};
  crypto_generichash_init(&state, nullptr, 0, result.size());
  const Bytes place_bytes = bytes_of(place);
  crypto_generichash_update(&state, place_bytes.data(), place_bytes.size());
  crypto_generichash_update(&state, bytes.data(), bytes.size());
  crypto_generichash_final(&state, result.data(), result.size());
  return result;
}

void check_version(Database& database, const std::string& file) {
  const std::int64_t version = database.number("PRAGMA user_version");
  if (database.number("PRAGMA application_id") != kApplication)
    throw Error("store " + file + " belongs to another program, expected one of saker-base");
  if (version != kVersion)
    throw Error("store " + file + " has version " + std::to_string(version) + ", expected " +
                std::to_string(kVersion) + ": it was written by a newer saker-base");
}

/// Throws Error where the file is not what SQLite left.
void check_whole(Database& database, const std::string& file) {
  const std::string found = database.text("PRAGMA quick_check(1)");
  if (found != "ok")
    throw Error("store " + file + " is damaged (" + found.substr(0, found.find('\n')) +
                "), mend with: sqlite3 " + file + " .recover | sqlite3 mended.db");
}

void make_tables(Database& database) {
  database.execute("PRAGMA journal_mode=WAL");
  if (database.number("PRAGMA schema_version") != 0) return;
  database.execute("BEGIN IMMEDIATE");
  database.execute(kTables);
  database.execute("PRAGMA application_id=" + std::to_string(kApplication));
  database.execute("PRAGMA user_version=" + std::to_string(kVersion));
  database.execute("COMMIT");
}

void set_ceiling(Database& database, int most_mb) {
  const std::int64_t pages = most_mb * kBytesOfAMegabyte / database.number("PRAGMA page_size");
  (void)database.number("PRAGMA max_page_count=" + std::to_string(pages));
}

/// The stream that a row of `kAllChunks` names; nothing where no stream has that name.
std::optional<StreamId> stream_of(const Statement& row) {
  const std::int64_t kind = row.integer(1), version = row.integer(2);
  StreamId id{row.text(0), StreamKind::history, static_cast<std::uint32_t>(version)};
  if (!exchange::is_name(id.robot) || id.version != version) return std::nullopt;
  if (kind < 0 || kind >= exchange::kStreamKinds) return std::nullopt;
  id.kind = static_cast<StreamKind>(kind);
  return id;
}

/// Calls `found(id, chunk, bytes)` for every chunk that is as it was written; how many are not.
template <class Found>
long for_each_chunk(Database& database, const Found& found) {
  long damaged = 0;
  Statement all(database.get(), kAllChunks);
  while (all.next()) {
    const auto id = stream_of(all);
    const auto chunk = static_cast<int>(all.integer(3));
    const std::vector<std::uint8_t> digest = all.bytes(4), bytes = all.bytes(5);
    const bool whole = id && !bytes.empty() && bytes.size() <= exchange::kChunkBytes &&
                       std::ranges::equal(digest, digest_of(*id, chunk, bytes));
    if (whole) {
      found(*id, chunk, bytes.size());
    } else {
      ++damaged;
    }
  }
  if (all.failed()) throw Error("store: " + database.fault());
  return damaged;
}

}  // namespace

DatabaseStore::DatabaseStore(const std::string& file, int most_mb)
    : file_(file), database_(file, Database::Access::write) {
  make_tables(database_);
  check_version(database_, file);
  check_whole(database_, file);
  database_.execute("PRAGMA synchronous=FULL; PRAGMA wal_autocheckpoint=" +
                    std::to_string(kPagesOfLog));
  set_ceiling(database_, most_mb);
  add_stream_ = std::make_unique<Statement>(
      database_.get(), "INSERT OR IGNORE INTO streams(robot, kind, version) VALUES(?1, ?2, ?3)");
  read_ = std::make_unique<Statement>(database_.get(),
                                      "SELECT bytes FROM chunks WHERE place=" + kPlace);
  write_ = std::make_unique<Statement>(
      database_.get(), "INSERT OR REPLACE INTO chunks VALUES(" + kPlace + ", ?5, ?6)");
  contact_ = std::make_unique<Statement>(database_.get(),
                                         "INSERT OR REPLACE INTO contacts VALUES(?1, ?2)");
  restore_all();
}

void DatabaseStore::restore_all() {
  damaged_ = for_each_chunk(database_, [this](const StreamId& id, int chunk, std::size_t bytes) {
    restore(id, chunk, bytes);
  });
  if (damaged_ > 0)
    spdlog::warn("store {}: {} chunks are damaged: whoever has them sends them again", file_,
                 damaged_);
}

bool DatabaseStore::keep(const StreamId& id, int chunk, std::size_t from, std::string_view bytes) {
  std::string whole = from > 0 ? load(id, chunk) : std::string();
  if (whole.size() != from) return false;
  whole += bytes;
  Trouble trouble = write(id, chunk, whole);
  // The log of what was written last takes room too: moved into the tables, it begins anew.
  if (trouble == Trouble::full && database_.checkpoint()) trouble = write(id, chunk, whole);
  notice(trouble);
  return trouble == Trouble::none;
}

DatabaseStore::Trouble DatabaseStore::write(const StreamId& id, int chunk, std::string_view whole) {
  const Digest digest = digest_of(id, chunk, bytes_of(whole));
  const std::string_view robot = id.robot;
  const std::int64_t kind = static_cast<std::int64_t>(id.kind), version = id.version;
  Transaction transaction(database_);
  const bool written =
      transaction.begun() && add_stream_->with(robot, kind, version).run() &&
      write_->with(robot, kind, version, std::int64_t{chunk}, Bytes(digest), bytes_of(whole))
          .run() &&
      transaction.commit();
  if (written) return Trouble::none;
  return database_.full() ? Trouble::full : Trouble::fault;
}

/// One line when it begins and one when it is over, however many chunks come.
void DatabaseStore::notice(Trouble trouble) {
  if (trouble == trouble_) return;
  trouble_ = trouble;
  if (trouble == Trouble::none) {
    spdlog::info("store {} takes chunks again", file_);
  } else {
    spdlog::error("store {} refuses chunks until it can be written: {}", file_,
                  trouble == Trouble::full ? "the disk is full, or base.most_store_mb is reached"
                                           : database_.fault());
  }
}

std::string DatabaseStore::load(const StreamId& id, int chunk) const {
  if (!read_
           ->with(std::string_view(id.robot), static_cast<std::int64_t>(id.kind),
                  std::int64_t{id.version}, std::int64_t{chunk})
           .next()) {
    return "";
  }
  const std::vector<std::uint8_t> bytes = read_->bytes(0);
  read_->reset();
  return {bytes.begin(), bytes.end()};
}

void DatabaseStore::note_contact(const std::string& robot, std::int64_t utime) {
  (void)contact_->with(std::string_view(robot), utime).run();
}

long DatabaseStore::file_bytes() const {
  std::error_code none;
  const auto bytes = std::filesystem::file_size(file_, none);
  return none ? 0 : static_cast<long>(bytes);
}

StoreReport read_report(const std::string& file) {
  if (!std::filesystem::exists(file))
    throw Error("store " + file + " is not there, expected what saker-base keeps");
  Database database(file, Database::Access::read);
  check_version(database, file);
  std::map<StreamId, exchange::Extent> extents;
  (void)for_each_chunk(database, [&](const StreamId& id, int chunk, std::size_t bytes) {
    extents[id].add(chunk, bytes);
  });
  std::map<std::string, StoreReport::Robot> robots;
  for (const auto& [id, extent] : extents) {
    robots[id.robot].streams.push_back(
        {id, extent.contiguous, static_cast<int>(extent.beyond.size())});
  }
  Statement contacts(database.get(), "SELECT robot, utime FROM contacts");
  while (contacts.next()) {
    const std::string robot = contacts.text(0);
    if (exchange::is_name(robot)) robots[robot].heard_utime = contacts.integer(1);
  }
  StoreReport report;
  for (auto& [name, robot] : robots) {
    robot.name = name;
    report.robots.push_back(std::move(robot));
  }
  report.file_bytes = static_cast<long>(std::filesystem::file_size(file));
  return report;
}

}  // namespace saker::flight
