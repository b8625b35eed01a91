#include "saker/exchange/robot_key.h"

#include <fmt/format.h>

#include <system_error>

#include "saker/exchange/key.h"

namespace saker::exchange {
namespace {

constexpr const char* kName = "robot.key";
constexpr const char* kOldName = "team.key";

bool is_there(const std::filesystem::path& file) {
  std::error_code hidden;
  return std::filesystem::exists(file, hidden);
}

}  // namespace

RobotKeyFile robot_key_file(const std::filesystem::path& configured) {
  const std::filesystem::path old = configured.parent_path() / kOldName;
  if (configured.filename() != kName || is_there(configured) || !is_there(old))
    return {configured, team_key_note(configured)};
  std::string note = team_key_note(old);
  if (note.empty()) {
    note = fmt::format("{} is not there: its old name {} is read; rename it with: mv {} {}",
                       configured.string(), old.string(), old.string(), configured.string());
  }
  return {old, note};
}

}  // namespace saker::exchange
