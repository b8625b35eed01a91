#pragma once

#include <filesystem>
#include <string>

/// Where a robot has its key.
namespace saker::exchange {

/// A robot's key file as it is found, and what is wrong with it.
struct RobotKeyFile {
  std::filesystem::path file;
  std::string note;  ///< one line; empty: nothing is wrong, or there is no file
};

/// A robot's own key is `robot.key`. It was called `team.key`, as the team's at the base: where a
/// `robot.key` is not there the file of the old name beside it is taken, and the note says so. The
/// note also says where the key is the team's, which stays at the base. Throws Error as `read_key`.
/// \param configured  `exchange.key_file`; one of any other name is taken as it is
[[nodiscard]] RobotKeyFile robot_key_file(const std::filesystem::path& configured);

}  // namespace saker::exchange
