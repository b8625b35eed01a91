#include "saker/lidar/kitti_folder.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <string>

#include "saker/core/error.h"
#include "saker/lidar/clouds/natural_order.h"
#include "saker/lidar/clouds/scan_times.h"
#include "saker/lidar/sensor_origin.h"

namespace saker::lidar {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostPoints = 4'000'000;

std::vector<fs::path> scans_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    if (entry.path().extension() == ".bin" && !entry.is_directory(ignored)) {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end(), [](const fs::path& x, const fs::path& y) {
    return natural_less(x.filename().string(), y.filename().string());
  });
  return files;
}

/// KITTI's raw recordings, SemanticKITTI, MulRan, or the folder itself.
fs::path scan_folder(const fs::path& folder) {
  std::error_code ignored;
  if (fs::is_directory(folder / "velodyne", ignored)) return folder / "velodyne";
  if (!scans_in(folder).empty()) return folder;
  for (const char* below : {"velodyne_points/data", "data", "Ouster"}) {
    if (!scans_in(folder / below).empty()) return folder / below;
  }
  return folder;
}

/// The fault, or empty when `buffer` holds the file's floats.
std::string read_floats(const fs::path& file, std::size_t bytes_a_point,
                        std::vector<float>& buffer) {
  std::error_code error;
  const auto bytes = fs::file_size(file, error);
  if (error) return "cannot be read: " + error.message();
  if (bytes == 0) return "holds no points";
  if (bytes % bytes_a_point != 0) {
    return std::to_string(bytes) + " bytes, expected a multiple of " +
           std::to_string(bytes_a_point);
  }
  if (bytes / bytes_a_point > kMostPoints) {
    return std::to_string(bytes / bytes_a_point) + " points, expected at most " +
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

/// Where the fields stand in a point.
PointLayout layout_of(const FloatFields& fields) {
  PointLayout layout;
  for (const std::string& field : fields) layout.append(field, NumberType::kF32);
  return layout;
}

const FloatFields kKittiFields = {"x", "y", "z", "intensity"};

void fill(const std::vector<float>& floats, Scan& scan) {
  const std::size_t floats_a_point = kKittiFields.size();
  const std::size_t points = floats.size() / floats_a_point;
  scan.points.reserve(points);
  scan.reflectivity.reserve(points);
  scan.offset_ns.assign(points, 0);
  for (std::size_t i = 0; i < floats.size(); i += floats_a_point) {
    scan.points.emplace_back(floats[i], floats[i + 1], floats[i + 2]);
    const float remission = floats[i + 3];
    scan.reflectivity.push_back(std::isfinite(remission) ? std::clamp(remission, 0.0F, 1.0F) : 0);
  }
}

}  // namespace

KittiFolder::KittiFolder(const fs::path& path, const std::string& point_fields) {
  std::error_code ignored;
  const bool one = fs::is_regular_file(path, ignored);
  const fs::path scans = one ? parent_of(path) : scan_folder(path);
  files_ = one ? std::vector<fs::path>{path} : scans_in(scans);
  if (files_.empty()) {
    throw Error(path.string() + ": no scans, expected *.bin in it or in velodyne/");
  }
  fields_ =
      point_fields.empty() ? find_fields(files_, path.string()) : parse_point_fields(point_fields);
  if (fields_ != kKittiFields) reader_.emplace(layout_of(fields_), path.string());
  times_ = one ? std::vector<Time>{0} : times_of_scans(scans, files_);
  if (fs::is_directory(parent_of(scans) / "ring", ignored)) rings_ = parent_of(scans) / "ring";
  T_lidar_sensor_ = find_sensor_origin(
      files_.size(), [this](std::size_t which, Scan& scan) { return read(which, scan); });
}

std::string KittiFolder::read(std::size_t which, Scan& scan) {
  const fs::path& file = files_[which];
  const std::size_t bytes_a_point = fields_.size() * sizeof(float);
  std::string fault = read_floats(file, bytes_a_point, buffer_);
  if (fault.empty() && reader_) {
    const ByteView bytes(reinterpret_cast<const std::uint8_t*>(buffer_.data()),
                         buffer_.size() * sizeof(float));
    fault =
        reader_->read(bytes, 1, bytes.size() / bytes_a_point, bytes.size(), times_[which], scan);
  } else if (fault.empty()) {
    fill(buffer_, scan);
  }
  if (!fault.empty()) return file.filename().string() + ": " + fault;
  if (T_lidar_sensor_) scan.T_lidar_sensor = *T_lidar_sensor_;
  return read_rings(rings_, file.stem().string(), scan);
}

std::string KittiFolder::note() const {
  std::string text;
  if (fields_ != kKittiFields) {
    text = std::to_string(fields_.size()) + " floats a point: " + describe_fields(fields_) +
           " (--point-fields says it otherwise)";
  }
  if (!T_lidar_sensor_) return text;
  return text + (text.empty() ? "" : "; ") + describe_sensor_origin(*T_lidar_sensor_);
}

std::optional<Frame> KittiFolder::next() {
  if (next_ >= files_.size()) return std::nullopt;
  const std::size_t which = next_++;
  Frame frame;
  frame.name = files_[which].stem().string();
  frame.scan.stamp = times_[which];
  frame.fault = read(which, frame.scan);
  if (!frame.fault.empty()) {
    ++counters_.faulty_scans;
    frame.scan = {};
    frame.scan.stamp = times_[which];
  }
  return frame;
}

bool is_kitti_folder(const fs::path& folder) {
  std::error_code ignored;
  return fs::is_directory(folder, ignored) && !scans_in(scan_folder(folder)).empty();
}

}  // namespace saker::lidar
