#pragma once

#include <filesystem>
#include <string_view>

namespace saker::exchange {

/// Who may read a file that is written.
enum class Access {
  owner,  ///< its owner, who runs this process, alone
  kept,   ///< as of the file that it replaces, but never everybody; without one: its owner
};

/// Writes a file whole or not at all, and on the disk when it returns; false where that failed.
[[nodiscard]] bool write_durably(const std::filesystem::path& file, std::string_view content,
                                 Access access = Access::owner);

/// All bytes at this place of an open file; false where that failed.
[[nodiscard]] bool write_at(int file, std::string_view bytes, std::size_t offset);

}  // namespace saker::exchange
