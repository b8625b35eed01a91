#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "flight/base_station/database.h"
#include "saker/exchange/store.h"

namespace saker::flight {

/// What the store holds of one stream, for people.
struct StoredStream {
  exchange::StreamId id;
  std::size_t bytes = 0;  ///< without a gap
  int gaps = 0;           ///< chunks that are held beyond the first gap
};

/// What every robot said, in one SQLite file.
///
/// Loses nothing: a chunk is one transaction that is on the disk (WAL, synchronous=FULL) before
/// `put` says so, so neither kill -9 nor a power cut takes back what was acknowledged. Nothing is
/// ever deleted or written over but the last chunk of a stream by one that begins with the same
/// bytes. Where there is no room (a full disk, the ceiling) chunks are refused, in one line of the
/// log, until there is; what is there stays readable.
class DatabaseStore : public exchange::Store {
 public:
  /// \param file  made where there is none
  /// \param most_mb  its ceiling
  /// Checks all that is there. A chunk whose bytes have changed on the disk is as if it were not
  /// there: who has it sends it again. Throws Error in one line where the file is no store, one of
  /// a newer version, damaged as a whole, or cannot be written.
  DatabaseStore(const std::string& file, int most_mb);

  /// Notes when a robot was heard last; what cannot be written is forgotten.
  void note_contact(const std::string& robot, std::int64_t utime);

  /// Whether the last chunk was refused for want of room.
  [[nodiscard]] bool full() const { return trouble_ == Trouble::full; }
  /// Size of the file, and how many chunks were found changed at the start.
  [[nodiscard]] long file_bytes() const;
  [[nodiscard]] long damaged() const { return damaged_; }

 protected:
  [[nodiscard]] bool keep(const exchange::StreamId& id, int chunk, std::size_t from,
                          std::string_view bytes) override;
  [[nodiscard]] std::string load(const exchange::StreamId& id, int chunk) const override;

 private:
  enum class Trouble { none, full, fault };

  void restore_all();
  [[nodiscard]] Trouble write(const exchange::StreamId& id, int chunk, std::string_view whole);
  void notice(Trouble trouble);

  std::string file_;
  Database database_;
  std::unique_ptr<Statement> add_stream_, read_, write_, contact_;
  Trouble trouble_ = Trouble::none;
  long damaged_ = 0;
};

/// What `saker base status` shows.
struct StoreReport {
  struct Robot {
    std::string name;
    std::optional<std::int64_t> heard_utime;  ///< system clock, of the base
    std::vector<StoredStream> streams;
  };
  std::vector<Robot> robots;
  long file_bytes = 0;
};

/// Reads a store beside the process that writes it. Throws Error as the store does.
[[nodiscard]] StoreReport read_report(const std::string& file);

}  // namespace saker::flight
