#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "saker/exchange/stream.h"

namespace saker::exchange {

/// What became of bytes that were put into a store.
enum class Kept {
  stored,    ///< and durable, as far as the store is
  repeated,  ///< were held already
  gap,       ///< begin after the end of what is held of their chunk
  refused,   ///< more streams or chunks than the ceiling, or a name that is none
  failed,    ///< the disk does not take them; nothing changed
};

/// The streams that a process holds. This class knows which bytes are there; where they are kept
/// is the derived class's part: MemoryStore, JournalStore (a file), the base station's database.
///
/// A derived class names what it finds at its start by `restore`, then is asked to `keep` and to
/// `load`. Nothing throws after construction. For one thread.
class Store {
 public:
  static constexpr std::size_t kMostStreams = 4096;

  virtual ~Store() = default;

  /// Of every stream that is held; changes with `put` and `append` only.
  [[nodiscard]] const std::map<StreamId, Extent>& extents() const { return extents_; }
  /// Bytes without a gap; 0 where nothing is held.
  [[nodiscard]] std::size_t size(const StreamId& id) const;

  /// Bytes `offset` … of a stream, within one chunk; what is held already is not written again.
  Kept put(const StreamId& id, std::size_t offset, std::string_view bytes);
  /// At the end of a stream of one's own; false when it could not all be kept.
  [[nodiscard]] bool append(const StreamId& id, std::string_view bytes);

  /// What is held of a chunk, from its beginning; empty where nothing is.
  [[nodiscard]] std::string chunk(const StreamId& id, int chunk) const;
  /// All bytes without a gap.
  [[nodiscard]] std::string bytes(const StreamId& id) const;

 protected:
  /// At the start: so many bytes of this chunk are held.
  void restore(const StreamId& id, int chunk, std::size_t bytes) { extents_[id].add(chunk, bytes); }

  /// Makes `bytes` durable behind the first `from` bytes of the chunk (from > 0: it grows); false
  /// when that failed, as if nothing had been asked.
  [[nodiscard]] virtual bool keep(const StreamId& id, int chunk, std::size_t from,
                                  std::string_view bytes) = 0;
  /// What was kept of a chunk; may be empty when it cannot be read.
  [[nodiscard]] virtual std::string load(const StreamId& id, int chunk) const = 0;

 private:
  std::map<StreamId, Extent> extents_;
};

/// Holds the bytes in memory; they end with the process.
class MemoryStore : public Store {
 protected:
  [[nodiscard]] bool keep(const StreamId& id, int chunk, std::size_t from,
                          std::string_view bytes) override;
  [[nodiscard]] std::string load(const StreamId& id, int chunk) const override;

 private:
  std::map<StreamId, std::map<int, std::string>> chunks_;
};

/// The newest version of one kind of a robot's streams; 0 where there is none.
[[nodiscard]] std::uint32_t newest_version(const Store& store, const std::string& robot,
                                           StreamKind kind);

/// A whole file as a stream: a new version unless the newest one holds these bytes already. The
/// version; 0 where it could not be kept.
std::uint32_t publish(Store& store, const std::string& robot, StreamKind kind,
                      std::string_view bytes);

}  // namespace saker::exchange
