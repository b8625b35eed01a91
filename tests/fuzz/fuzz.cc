#include "fuzz.h"

#include <unistd.h>

#include <cstdlib>
#include <fstream>

namespace saker::lidar::fuzz {
namespace {

/// Removed at the end.
class Folder {
 public:
  Folder()
      : path_(std::filesystem::temp_directory_path() /
              ("saker-fuzz-" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace

void expect(bool right) {
  if (!right) std::abort();
}

std::filesystem::path file_of(ByteView input, const std::string& extension) {
  static const Folder folder;
  const std::filesystem::path file = folder.path() / ("input" + extension);
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(input.data()),
             static_cast<std::streamsize>(input.size()));
  return file;
}

}  // namespace saker::lidar::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  try {
    saker::lidar::fuzz::run({bytes, size});
  } catch (const saker::Error& error) {
    if (std::string(error.what()).find('\n') != std::string::npos) std::abort();
  }
  return 0;
}
