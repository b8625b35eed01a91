#include "saker/lidar/clouds/cloud_folder.h"

#include <algorithm>

#include "saker/core/error.h"
#include "saker/core/one_line.h"
#include "saker/lidar/clouds/cloud_file.h"
#include "saker/lidar/clouds/natural_order.h"
#include "saker/lidar/clouds/scan_times.h"
#include "saker/lidar/file_bytes.h"
#include "saker/lidar/sensor_origin.h"

namespace saker::lidar {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kFirstBytes = 16;

bool is_cloud(const fs::path& file) {
  return cloud_format(first_bytes(file, kFirstBytes)) != CloudFormat::kNone;
}

std::vector<fs::path> clouds_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    if (entry.is_regular_file(ignored) && is_cloud(entry.path())) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end(), [](const fs::path& x, const fs::path& y) {
    return natural_less(x.filename().string(), y.filename().string());
  });
  return files;
}

/// Two clouds that are read the same way.
bool same(const PointLayout& a, const PointLayout& b) {
  const auto equal = [](const PointField& x, const PointField& y) {
    return x.name == y.name && x.offset == y.offset && x.type == y.type;
  };
  return a.step == b.step && a.big_endian == b.big_endian &&
         std::equal(a.fields.begin(), a.fields.end(), b.fields.begin(), b.fields.end(), equal);
}

}  // namespace

fs::path cloud_folder_in(const fs::path& folder) {
  for (const char* below : {"", "velodyne", "clouds", "pcd", "scans", "lidar", "points", "data"}) {
    const fs::path candidate = *below == 0 ? folder : folder / below;
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(candidate, ignored)) {
      if (entry.is_regular_file(ignored) && is_cloud(entry.path())) return candidate;
    }
  }
  return {};
}

CloudFolder::CloudFolder(const fs::path& path) {
  std::error_code ignored;
  const bool one = fs::is_regular_file(path, ignored);
  const fs::path folder = one ? parent_of(path) : cloud_folder_in(path);
  files_ = one ? std::vector<fs::path>{path} : clouds_in(folder);
  if (files_.empty()) throw Error(path.string() + ": no scans, expected PCD, PLY or .npy files");
  times_ = one ? std::vector<Time>{0} : times_of_scans(folder, files_);
  Cloud cloud;
  const std::string fault = read_cloud(files_.front(), cloud);
  if (!fault.empty()) throw Error(files_.front().string() + ": " + fault);
  reader_.emplace(cloud.layout, files_.front().string());
  T_lidar_sensor_ = find_sensor_origin(
      files_.size(), [this](std::size_t which, Scan& scan) { return read(which, scan); });
}

std::string CloudFolder::read(std::size_t which, Scan& scan) {
  const fs::path& file = files_[which];
  Cloud cloud;
  std::string fault = read_cloud(file, cloud);
  if (fault.empty() && !same(cloud.layout, reader_->layout())) {
    fault = "fields " + cloud.layout.names() + ", expected those of the first scan, " +
            reader_->layout().names();
  }
  if (fault.empty()) {
    fault = reader_->read(cloud.bytes, cloud.rows, cloud.columns, cloud.columns * cloud.layout.step,
                          times_[which], scan);
  }
  if (!fault.empty()) return one_line(file.filename().string() + ": " + fault);
  if (T_lidar_sensor_) scan.T_lidar_sensor = *T_lidar_sensor_;
  return "";
}

std::string CloudFolder::note() const {
  const std::string text = "fields of a point: " + reader_->layout().names();
  return T_lidar_sensor_ ? text + "; " + describe_sensor_origin(*T_lidar_sensor_) : text;
}

std::optional<Frame> CloudFolder::next() {
  if (next_ >= files_.size()) return std::nullopt;
  const std::size_t which = next_++;
  Frame frame;
  frame.name = files_[which].stem().string();
  frame.fault = read(which, frame.scan);
  if (!frame.fault.empty()) {
    ++counters_.faulty_scans;
    frame.scan = {};
    frame.scan.stamp = times_[which];
  }
  return frame;
}

}  // namespace saker::lidar
