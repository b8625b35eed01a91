#include "saker/core/config_folder.h"

#include <cstdlib>
#include <vector>

#include "saker/core/error.h"

namespace saker::core {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> config_folders() {
  std::vector<fs::path> folders;
  if (const char* given = std::getenv("SAKER_CONFIG_DIR")) folders.emplace_back(given);
  std::error_code failed;
  const fs::path program = fs::read_symlink("/proc/self/exe", failed);
  if (!failed) {
    folders.push_back(program.parent_path() / "../../../configs");
    folders.push_back(program.parent_path() / "../share/saker");
  }
  folders.emplace_back(SAKER_CONFIG_DIR);
  return folders;
}

}  // namespace

fs::path find_in_configs(const std::string& file, const std::string& key) {
  if (fs::is_regular_file(file)) return file;
  std::string looked = file;
  for (const fs::path& folder : config_folders()) {
    const fs::path candidate = (folder / file).lexically_normal();
    if (fs::is_regular_file(candidate)) return candidate;
    if (looked.find(candidate.string()) == std::string::npos) looked += ", " + candidate.string();
  }
  throw Error(key + ": no such file: looked for " + looked);
}

}  // namespace saker::core
