#pragma once

#include <array>
#include <cstdint>
#include <filesystem>

/// The team's key: whoever has it belongs to the team.
namespace saker::exchange {

using Key = std::array<std::uint8_t, 32>;

/// A file of 64 hexadecimal digits. Throws Error in one line where it cannot be read, holds
/// something else, or may be read by everybody.
[[nodiscard]] Key read_key(const std::filesystem::path& file);

/// Draws a key and writes it, readable by its owner only. Throws Error where the file exists.
void make_key_file(const std::filesystem::path& file);

}  // namespace saker::exchange
