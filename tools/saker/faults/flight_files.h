#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "saker/core/rng.h"
#include "saker/exchange/journal_store.h"
#include "saker/objects/class_table.h"
#include "saker/objects/object_map.h"
#include "tools/saker/faults/fault.h"

namespace saker::tools {

/// What a flight writes on its way, by the writers of the product: a map as JSON and packed
/// (core/files.h), a short file that is to be on the disk at once (exchange/durable.h), a journal
/// (exchange/journal_store.h). Reads the newest map, makes the list of files that are not whole.
///
/// The disk may be full (the kernel's own answer: a file in the making leads to /dev/full), slow,
/// or lose its power in the middle of a write: half of a file in the making and a part of the
/// journal's last record are left, and all is opened again. Whole is a file that holds what was
/// last written to it with success; the journal may lose what was being written at a cut, and
/// nothing else.
class FlightFiles {
 public:
  /// Makes `folder`, removes it with what is in it at its end. `schedule` and `table` have to
  /// outlive this. Throws Error where it cannot be made.
  FlightFiles(std::filesystem::path folder, const FaultSchedule& schedule,
              const objects::ClassTable& table);
  ~FlightFiles();
  FlightFiles(const FlightFiles&) = delete;
  FlightFiles& operator=(const FlightFiles&) = delete;

  /// At `t_s` of the mission: written where two seconds have passed since the last time and the
  /// disk has finished that. \return what is not whole now, a line each
  [[nodiscard]] std::vector<std::string> write(double t_s, const objects::ObjectMap& map);

  [[nodiscard]] int written() const { return written_; }  ///< times that all could be written
  [[nodiscard]] int failed() const { return failed_; }    ///< that something could not

 private:
  void write_all(double t_s, const objects::ObjectMap& map);
  void append(double t_s);
  void lose_power();
  [[nodiscard]] std::vector<std::string> torn(std::size_t objects) const;

  std::filesystem::path folder_;
  const FaultSchedule& schedule_;
  const objects::ClassTable& table_;
  core::Rng rng_;
  std::unique_ptr<exchange::JournalStore> journal_;
  std::string said_;                          // to the journal, with success
  std::size_t sure_ = 0;                      // of it, before the last record
  std::map<std::string, std::string> whole_;  // name → content of the last success
  std::size_t objects_ = 0;                   // in the last map that was written
  double next_s_ = 0;
  int written_ = 0, failed_ = 0;
};

}  // namespace saker::tools
