#include "saker/lidar/kitti_folder.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <set>
#include <string>

#include "saker/core/error.h"
#include "saker/lidar/sensor_origin.h"

namespace saker::lidar {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kFloatsAPoint = 4;
constexpr std::size_t kBytesAPoint = kFloatsAPoint * sizeof(float);
constexpr std::size_t kMostPoints = 4'000'000;
constexpr Time kTenthOfSecond = kNanosecondsPerSecond / 10;
constexpr double kLargestTime = 9e9;  // seconds; beyond it nanoseconds overflow

std::vector<fs::path> scans_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    if (entry.path().extension() == ".bin" && !entry.is_directory(ignored)) {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

fs::path scan_folder(const fs::path& folder) {
  std::error_code ignored;
  return fs::is_directory(folder / "velodyne", ignored) ? folder / "velodyne" : folder;
}

fs::path parent_of(const fs::path& scans) {
  const fs::path whole = fs::absolute(scans).lexically_normal();
  return (whole.has_filename() ? whole : whole.parent_path()).parent_path();
}

fs::path times_file(const fs::path& scans) {
  std::error_code ignored;
  for (const fs::path& file : {scans / "times.txt", parent_of(scans) / "times.txt"}) {
    if (fs::is_regular_file(file, ignored)) return file;
  }
  return {};
}

std::vector<Time> read_times(const fs::path& file) {
  std::ifstream in(file);
  std::vector<Time> times;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    char* end = nullptr;
    const double seconds = std::strtod(line.c_str(), &end);
    const bool whole = end != line.c_str() &&
                       line.find_first_not_of(" \t\r", end - line.c_str()) == std::string::npos;
    if (!whole || !(std::abs(seconds) < kLargestTime)) {
      throw Error(file.string() + ":" + std::to_string(number) + ": \"" + line.substr(0, 40) +
                  "\", expected a time in seconds");
    }
    times.push_back(from_seconds(seconds));
  }
  return times;
}

std::vector<Time> times_of(const fs::path& scans, std::size_t count) {
  const fs::path file = times_file(scans);
  std::vector<Time> times;
  if (file.empty()) {
    for (std::size_t i = 0; i < count; ++i) times.push_back(kTenthOfSecond * static_cast<Time>(i));
    return times;
  }
  times = read_times(file);
  if (times.size() != count) {
    throw Error(file.string() + ": " + std::to_string(times.size()) + " times, expected " +
                std::to_string(count) + ", one a scan");
  }
  return times;
}

/// The fault, or empty when `buffer` holds the file's floats.
std::string read_floats(const fs::path& file, std::vector<float>& buffer) {
  std::error_code error;
  const auto bytes = fs::file_size(file, error);
  if (error) return "cannot be read: " + error.message();
  if (bytes == 0) return "holds no points";
  if (bytes % kBytesAPoint != 0) {
    return std::to_string(bytes) + " bytes, expected a multiple of " + std::to_string(kBytesAPoint);
  }
  if (bytes / kBytesAPoint > kMostPoints) {
    return std::to_string(bytes / kBytesAPoint) + " points, expected at most " +
           std::to_string(kMostPoints);
  }
  buffer.resize(bytes / sizeof(float));
  std::ifstream in(file, std::ios::binary);
  in.read(reinterpret_cast<char*>(buffer.data()), static_cast<std::streamsize>(bytes));
  return in ? "" : "cannot be read";
}

/// Ring numbers of one scan, if the folder has them. \return the fault, or empty
template <class Number>
std::string take_rings(const fs::path& file, Scan& scan) {
  std::ifstream in(file, std::ios::binary);
  std::vector<Number> numbers(scan.size());
  const auto bytes = static_cast<std::streamsize>(numbers.size() * sizeof(Number));
  in.read(reinterpret_cast<char*>(numbers.data()), bytes);
  if (in.gcount() != bytes || in.peek() != std::ifstream::traits_type::eof()) {
    return "ring/" + file.filename().string() + " does not hold " + std::to_string(scan.size()) +
           " ring numbers, one a point";
  }
  scan.ring.assign(numbers.begin(), numbers.end());
  return "";
}

std::string read_rings(const fs::path& folder, const std::string& stem, Scan& scan) {
  std::error_code ignored;
  if (folder.empty()) return "";
  const fs::path bytes = folder / (stem + ".u8"), words = folder / (stem + ".u16");
  if (fs::is_regular_file(bytes, ignored)) return take_rings<std::uint8_t>(bytes, scan);
  if (fs::is_regular_file(words, ignored)) return take_rings<std::uint16_t>(words, scan);
  return "";
}

void fill(const std::vector<float>& floats, Scan& scan) {
  const std::size_t points = floats.size() / kFloatsAPoint;
  scan.points.reserve(points);
  scan.reflectivity.reserve(points);
  scan.offset_ns.assign(points, 0);
  for (std::size_t i = 0; i < floats.size(); i += kFloatsAPoint) {
    scan.points.emplace_back(floats[i], floats[i + 1], floats[i + 2]);
    const float remission = floats[i + 3];
    scan.reflectivity.push_back(std::isfinite(remission) ? std::clamp(remission, 0.0F, 1.0F) : 0);
  }
}

}  // namespace

KittiFolder::KittiFolder(const fs::path& folder) {
  const fs::path scans = scan_folder(folder);
  files_ = scans_in(scans);
  if (files_.empty()) {
    throw Error(folder.string() + ": no scans, expected *.bin in it or in velodyne/");
  }
  times_ = times_of(scans, files_.size());
  std::error_code ignored;
  if (fs::is_directory(parent_of(scans) / "ring", ignored)) rings_ = parent_of(scans) / "ring";
  find_origin();
}

std::string KittiFolder::read(const fs::path& file, Scan& scan) {
  const std::string fault = read_floats(file, buffer_);
  if (!fault.empty()) return file.filename().string() + ": " + fault;
  fill(buffer_, scan);
  if (T_lidar_sensor_) scan.T_lidar_sensor = *T_lidar_sensor_;
  return read_rings(rings_, file.stem().string(), scan);
}

void KittiFolder::find_origin() {
  std::vector<Scan> scans;
  const std::size_t last = files_.size() - 1;
  for (const std::size_t i : std::set<std::size_t>{0, last / 2, last}) {
    Scan scan;
    if (read(files_[i], scan).empty()) scans.push_back(std::move(scan));
  }
  T_lidar_sensor_ = find_sensor_origin(scans);
}

std::string KittiFolder::note() const {
  return T_lidar_sensor_ ? describe_sensor_origin(*T_lidar_sensor_) : "";
}

std::optional<Frame> KittiFolder::next() {
  if (next_ >= files_.size()) return std::nullopt;
  const fs::path& file = files_[next_];
  Frame frame;
  frame.name = file.stem().string();
  frame.scan.stamp = times_[next_++];
  frame.fault = read(file, frame.scan);
  if (!frame.fault.empty()) {
    ++counters_.faulty_scans;
    frame.scan = {};
    frame.scan.stamp = times_[next_ - 1];
  }
  return frame;
}

bool is_kitti_folder(const fs::path& folder) {
  std::error_code ignored;
  return fs::is_directory(folder, ignored) && !scans_in(scan_folder(folder)).empty();
}

}  // namespace saker::lidar
