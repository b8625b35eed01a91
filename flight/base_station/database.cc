#include "flight/base_station/database.h"

#include <sqlite3.h>

#include "saker/core/error.h"

namespace saker::flight {
namespace {

constexpr int kBusyMs = 500;  // for a reader that closes, which may tidy up

}  // namespace

Statement::Statement(sqlite3* database, const std::string& sql) {
  if (sqlite3_prepare_v3(database, sql.c_str(), -1, SQLITE_PREPARE_PERSISTENT, &statement_,
                         nullptr) != SQLITE_OK) {
    throw Error("store: " + std::string(sqlite3_errmsg(database)));
  }
}

Statement::~Statement() { sqlite3_finalize(statement_); }

void Statement::reset() {
  sqlite3_reset(statement_);
  sqlite3_clear_bindings(statement_);
}

void Statement::bind(int place, std::int64_t value) {
  sqlite3_bind_int64(statement_, place, value);
}

void Statement::bind(int place, std::string_view text) {
  sqlite3_bind_text(statement_, place, text.data(), static_cast<int>(text.size()), SQLITE_STATIC);
}

void Statement::bind(int place, std::span<const std::uint8_t> bytes) {
  // No bytes are an empty blob, not NULL.
  const void* const data = bytes.empty() ? "" : static_cast<const void*>(bytes.data());
  sqlite3_bind_blob(statement_, place, data, static_cast<int>(bytes.size()), SQLITE_STATIC);
}

bool Statement::next() {
  const int status = sqlite3_step(statement_);
  if (status == SQLITE_ROW) return true;
  failed_ = status != SQLITE_DONE;
  sqlite3_reset(statement_);
  return false;
}

bool Statement::run() {
  while (next()) {
  }
  return !failed_;
}

std::int64_t Statement::integer(int column) const {
  return sqlite3_column_int64(statement_, column);
}

std::string Statement::text(int column) const {
  const auto* const data = reinterpret_cast<const char*>(sqlite3_column_text(statement_, column));
  return data == nullptr ? "" : data;
}

std::vector<std::uint8_t> Statement::bytes(int column) const {
  const auto* const data =
      static_cast<const std::uint8_t*>(sqlite3_column_blob(statement_, column));
  return {data, data + sqlite3_column_bytes(statement_, column)};
}

Database::Database(const std::string& file, Access access) : file_(file) {
  const int flags =
      access == Access::read ? SQLITE_OPEN_READONLY : SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
  const int status = sqlite3_open_v2(file.c_str(), &database_, flags, nullptr);
  if (status != SQLITE_OK) {
    const std::string line = "store " + file_ + " cannot be opened: " + fault();
    sqlite3_close(database_);
    throw Error(line);
  }
  sqlite3_busy_timeout(database_, kBusyMs);
}

Database::~Database() { sqlite3_close(database_); }

void Database::execute(const std::string& sql) {
  if (sqlite3_exec(database_, sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) fail();
}

std::int64_t Database::number(const std::string& sql) {
  Statement statement(database_, sql);
  if (!statement.next()) fail();
  return statement.integer(0);
}

std::string Database::text(const std::string& sql) {
  Statement statement(database_, sql);
  if (!statement.next()) fail();
  return statement.text(0);
}

bool Database::checkpoint() {
  return sqlite3_wal_checkpoint_v2(database_, nullptr, SQLITE_CHECKPOINT_TRUNCATE, nullptr,
                                   nullptr) == SQLITE_OK;
}

bool Database::full() const {
  const int code = sqlite3_extended_errcode(database_);
  return (code & 0xff) == SQLITE_FULL || code == SQLITE_IOERR_WRITE ||
         code == SQLITE_IOERR_SHMSIZE || sqlite3_system_errno(database_) == ENOSPC;
}

std::string Database::fault() const { return sqlite3_errmsg(database_); }

void Database::fail() const { throw Error("store " + file_ + ": " + fault()); }

Transaction::Transaction(Database& database) : database_(database) {
  open_ = run("BEGIN IMMEDIATE");
}

Transaction::~Transaction() {
  if (open_) run("ROLLBACK");
}

bool Transaction::commit() {
  if (!open_ || !run("COMMIT")) return false;
  open_ = false;
  return true;
}

bool Transaction::run(const char* sql) {
  return sqlite3_exec(database_.get(), sql, nullptr, nullptr, nullptr) == SQLITE_OK;
}

}  // namespace saker::flight
