#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "saker/lidar/cursor.h"

namespace saker::lidar {

/// A file that is read piece by piece, wherever the reader wants.
class FileBytes {
 public:
  /// Throws Error when it cannot be opened.
  explicit FileBytes(const std::filesystem::path& file);
  ~FileBytes();
  FileBytes(const FileBytes&) = delete;
  FileBytes& operator=(const FileBytes&) = delete;

  [[nodiscard]] std::uint64_t size() const { return size_; }

  /// Up to `count` bytes from `offset` on, fewer where the file ends.
  void read(std::uint64_t offset, std::size_t count, std::vector<std::uint8_t>& into) const;

 private:
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

/// The first bytes of a file, fewer where it is shorter; empty where it cannot be read.
[[nodiscard]] std::vector<std::uint8_t> first_bytes(const std::filesystem::path& file,
                                                    std::size_t count);

}  // namespace saker::lidar
