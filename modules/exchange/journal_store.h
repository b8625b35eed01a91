#pragma once

#include <filesystem>

#include "saker/exchange/store.h"

namespace saker::exchange {

/// Keeps the streams in memory and in one file, a journal that is only appended to: what a robot
/// holds. A record that a sudden end cut off is dropped at the next start.
class JournalStore : public MemoryStore {
 public:
  /// Throws Error when the file cannot be read or written, or is another one.
  explicit JournalStore(const std::filesystem::path& file);
  ~JournalStore() override;
  JournalStore(const JournalStore&) = delete;
  JournalStore& operator=(const JournalStore&) = delete;

 protected:
  [[nodiscard]] bool keep(const StreamId& id, int chunk, std::size_t from,
                          std::string_view bytes) override;

 private:
  void read_back(const std::string& journal);

  int file_ = -1;
  std::size_t size_ = 0;  // of the whole records
};

}  // namespace saker::exchange
