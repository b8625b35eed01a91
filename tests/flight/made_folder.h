#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

namespace saker::flight {

/// A folder that is removed at the end.
class MadeFolder {
 public:
  MadeFolder() {
    std::string form = (std::filesystem::temp_directory_path() / "saker_made_XXXXXX").string();
    path_ = mkdtemp(form.data());
  }
  ~MadeFolder() { std::filesystem::remove_all(path_); }
  MadeFolder(const MadeFolder&) = delete;
  MadeFolder& operator=(const MadeFolder&) = delete;

  [[nodiscard]] std::filesystem::path operator/(const std::string& name) const {
    return path_ / name;
  }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace saker::flight
