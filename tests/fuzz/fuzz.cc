#include "fuzz.h"

#include <unistd.h>

#include <cstdlib>
#include <fstream>

#include "saker/core/error.h"

namespace saker::lidar::fuzz {
namespace {

void expect(bool right) {
  if (!right) std::abort();
}

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

std::filesystem::path file_of(ByteView input, const std::string& extension) {
  static const Folder folder;
  const std::filesystem::path file = folder.path() / ("input" + extension);
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(input.data()),
             static_cast<std::streamsize>(input.size()));
  return file;
}

void expect_consistent(const Frame& frame) {
  const Scan& scan = frame.scan;
  expect(frame.fault.find('\n') == std::string::npos);
  expect(scan.points.empty() == !frame.fault.empty());
  expect(scan.reflectivity.size() == scan.size() && scan.offset_ns.size() == scan.size());
  expect(scan.ring.empty() || scan.ring.size() == scan.size());
  for (const float value : scan.reflectivity) expect(value >= 0 && value <= 1);
  for (const std::int32_t offset : scan.offset_ns) expect(offset <= 0);
  for (const ImuSample& sample : frame.imu) {
    expect(sample.acceleration.allFinite() && sample.angular_velocity.allFinite());
  }
}

void read_all(ScanSource& source) {
  expect(source.expected_scans() >= 0);
  while (const auto frame = source.next()) expect_consistent(*frame);
  expect(source.note().find('\n') == std::string::npos);
  expect(source.counters().summary().find('\n') == std::string::npos);
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
