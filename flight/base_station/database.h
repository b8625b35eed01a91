#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

struct sqlite3;
struct sqlite3_stmt;

/// SQLite as the store uses it: whole statements, no exceptions but at the start.
namespace saker::flight {

/// A statement that is prepared once and run often.
class Statement {
 public:
  Statement(sqlite3* database, const std::string& sql);  ///< throws Error
  ~Statement();
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  /// Binds the parameters in their order; texts and bytes have to outlive the run.
  template <class... Values>
  Statement& with(const Values&... values) {
    reset();
    int place = 0;
    (bind(++place, values), ...);
    return *this;
  }

  /// True where there is a row; false at the end and after a fault. At the end nothing is held.
  bool next();
  /// Runs it to its end; whether it went well.
  bool run();

  [[nodiscard]] std::int64_t integer(int column) const;
  [[nodiscard]] std::string text(int column) const;
  [[nodiscard]] std::vector<std::uint8_t> bytes(int column) const;
  /// Whether the last run ended with a fault.
  [[nodiscard]] bool failed() const { return failed_; }
  /// Ends a run before its end, so that nothing is held.
  void reset();

 private:
  void bind(int place, std::int64_t value);
  void bind(int place, std::string_view text);
  void bind(int place, std::span<const std::uint8_t> bytes);

  sqlite3_stmt* statement_ = nullptr;
  bool failed_ = false;
};

class Database {
 public:
  enum class Access { read, write };

  /// Throws Error where the file is no database or cannot be opened.
  Database(const std::string& file, Access access);
  ~Database();
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  /// Runs statements without results; throws Error. At the start only.
  void execute(const std::string& sql);
  /// The one number that a query gives; throws Error.
  [[nodiscard]] std::int64_t number(const std::string& sql);
  /// The one text that a query gives; throws Error.
  [[nodiscard]] std::string text(const std::string& sql);

  /// Moves what was written last from the log into the tables; whether all of it could be.
  [[nodiscard]] bool checkpoint();

  /// Whether what was refused last was refused for want of room.
  [[nodiscard]] bool full() const;
  /// What was wrong last, in SQLite's words.
  [[nodiscard]] std::string fault() const;

  [[nodiscard]] sqlite3* get() const { return database_; }

 private:
  [[noreturn]] void fail() const;

  std::string file_;
  sqlite3* database_ = nullptr;
};

/// What is written between its begin and `commit` is there whole or not at all.
class Transaction {
 public:
  explicit Transaction(Database& database);
  ~Transaction();  ///< takes back what was not committed
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;

  [[nodiscard]] bool begun() const { return open_; }
  /// Whether it is on the disk now.
  [[nodiscard]] bool commit();

 private:
  bool run(const char* sql);

  Database& database_;
  bool open_ = false;
};

}  // namespace saker::flight
