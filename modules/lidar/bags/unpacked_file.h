#pragma once

#include <filesystem>

namespace saker::lidar {

/// A file that is packed with zstd as a whole (`ros2 bag record --compression-mode file`), unpacked
/// into the system's temporary folder and gone with this object; any other file as it is.
class UnpackedFile {
 public:
  /// Throws Error where it cannot be read or there is no room. Of a cut file there is what there
  /// is.
  explicit UnpackedFile(const std::filesystem::path& file);
  ~UnpackedFile();
  UnpackedFile(const UnpackedFile&) = delete;
  UnpackedFile& operator=(const UnpackedFile&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] bool cut() const { return cut_; }

 private:
  std::filesystem::path path_;
  bool temporary_ = false;
  bool cut_ = false;
};

[[nodiscard]] bool is_zstd(const std::filesystem::path& file);

}  // namespace saker::lidar
