#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "saker/core/files.h"
#include "saker/core/time.h"

namespace saker::flight::viewers {

/// Writes an MCAP file (the specification of mcap.dev, version 0): messages in chunks of 1 MB,
/// compressed by zstd, with indices, checksums and a summary. It has its name once it is finished;
/// without `finish` nothing is left. Throws Error where it cannot be written, and from then on
/// always: a file with a hole is never finished.
class McapWriter {
 public:
  struct Channel {
    std::string topic;
    std::string encoding;  ///< of messages: "json", "cdr"
    std::string schema_name, schema_encoding, schema;
  };

  explicit McapWriter(const std::filesystem::path& file);

  /// \return its id, from 1. Channels with the same schema share it.
  [[nodiscard]] std::uint16_t add(const Channel& channel);

  /// \param time  of the log and of the message, ns, at least 0
  void write(std::uint16_t channel, Time time, std::string_view bytes);

  void finish();

  [[nodiscard]] std::uint64_t messages() const { return messages_; }

 private:
  struct Chunk {
    std::string records;
    Time begin = 0, end = 0;
    std::map<std::uint16_t, std::vector<std::pair<std::uint64_t, std::uint64_t>>> index;
  };

  void put(std::string_view bytes);
  void close_chunk();
  [[nodiscard]] std::string statistics() const;

  core::OutputFile out_;
  bool broken_ = false;
  std::uint64_t at_ = 0;  ///< bytes written
  std::uint64_t messages_ = 0;
  std::uint32_t chunks_ = 0;
  Time begin_ = 0, end_ = 0;
  Chunk chunk_;
  std::map<std::string, std::uint16_t> schema_ids_;  ///< by encoding, name and text
  std::string schemas_, channels_, chunk_indices_;   ///< records of the summary
  std::map<std::uint16_t, std::uint64_t> counts_;    ///< messages by channel
  std::map<std::uint16_t, std::uint32_t> sequences_;
  std::string fresh_;  ///< schemas and channels that go into the next chunk
};

}  // namespace saker::flight::viewers
