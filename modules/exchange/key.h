#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

/// The team's key, and of each robot one of its own that follows from it: the base opens what every
/// robot seals, a robot only what is its own.
namespace saker::exchange {

/// 32 bytes, and whose they are.
struct Key : std::array<std::uint8_t, 32> {
  std::string robot{};  ///< whose key it is; empty: the team's, from which those of robots follow
  /// Of the team's: how often a robot's key was renewed; a robot that is not listed: never.
  std::map<std::string, std::uint32_t> renewed{};
};

/// A file of 64 hexadecimal digits, and after them a line "R1 2" for each robot whose key was
/// renewed (the team's); or of "R1 " and 64 digits (a robot's). Throws Error in one line where it
/// cannot be read, holds something else, or may be read by everybody.
[[nodiscard]] Key read_key(const std::filesystem::path& file);

/// Draws a key of a team and writes it, readable by its owner only. Throws Error where the file
/// exists.
void make_key_file(const std::filesystem::path& file);

/// The key of this robot; nothing where `key` is another robot's. It follows from the team's key,
/// the name and how often it was renewed (BLAKE2b-256, keyed), so that nobody without the team's
/// key can tell one from another.
[[nodiscard]] std::optional<Key> key_of(const Key& key, const std::string& robot);

/// What becomes of a file that is there.
enum class Existing { refused, replaced };

/// Writes the robot's key, readable by its owner only, or by whoever may read the file that it
/// replaces. Throws Error where `key` is not the team's, the name is none, or the file exists and
/// is not to be replaced.
void make_robot_key_file(const Key& key, const std::string& robot,
                         const std::filesystem::path& file, Existing existing = Existing::refused);

/// Renews the robot's key: writes the new one to `robot_file`, in place of what is there, then that
/// it was renewed into the team's file, whose owner and readers stay. Both are on the disk when it
/// returns: what was sealed with the keys before is not opened any more. Throws Error as `read_key`
/// and where a file cannot be written; then the keys before hold, and it may be called again.
void renew_key(const std::filesystem::path& team_file, const std::string& robot,
               const std::filesystem::path& robot_file);

/// Throws Error in one line where this is the key of another robot than `name`.
void require_key_of(const Key& key, const std::string& name);

/// What is wrong with the key's file on a robot, in one line: it is the team's, which stays at the
/// base. Empty: nothing is, or there is no file. Throws Error as `read_key`.
[[nodiscard]] std::string team_key_note(const std::filesystem::path& file);

}  // namespace saker::exchange
