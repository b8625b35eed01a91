#include "saker/simulation/sensor/scan_files.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <numbers>

#include "saker/core/error.h"

namespace saker::simulation {
namespace {

template <class T>
void write_file(const std::filesystem::path& path, const std::vector<T>& values) {
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(values.data()),
             static_cast<std::streamsize>(values.size() * sizeof(T)));
  file.close();
  if (!file) throw Error(path.string() + ": cannot be written");
}

std::string name_of_scan(std::size_t index) {
  char name[16];
  std::snprintf(name, sizeof(name), "%06zu", index);
  return name;
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw Error(folder.string() + ": cannot be made: " + error.message());
}

/// Camera axes: x right, y down, z forward.
SE3 T_camera_lidar() {
  SE3 T = SE3::Identity();
  T.linear() << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  return T;
}

void write_row(std::ostream& out, const SE3& T) {
  char number[40];
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) {
      const double value = std::abs(T(row, column)) < 1e-12 ? 0 : T(row, column);
      std::snprintf(number, sizeof(number), "%s%.9g", row + column > 0 ? " " : "", value);
      out << number;
    }
  }
  out << '\n';
}

}  // namespace

std::vector<std::size_t> ring_order(const CastScan& scan) {
  std::vector<std::size_t> order;
  std::vector<std::pair<float, std::size_t>> ring;
  for (int row = 0; row < scan.rows; ++row) {
    ring.clear();
    for (int column = 0; column < scan.columns; ++column) {
      const std::size_t i = static_cast<std::size_t>(row) * scan.columns + column;
      if (scan.range_m[i] <= 0) continue;
      const float azimuth = std::atan2(scan.points[i].y(), scan.points[i].x());
      ring.emplace_back(azimuth < 0 ? azimuth + 2 * std::numbers::pi_v<float> : azimuth, i);
    }
    std::sort(ring.begin(), ring.end());
    for (const auto& [azimuth, i] : ring) order.push_back(i);
  }
  return order;
}

LabelledScanWriter::LabelledScanWriter(const std::filesystem::path& folder) : folder_(folder) {
  for (const char* part : {"velodyne", "labels"}) make_folder(folder / part);
}

void LabelledScanWriter::write(const CastScan& scan, const SE3& T_world_lidar, Time stamp) {
  std::vector<float> points;
  std::vector<std::uint32_t> labels;
  for (const std::size_t i : ring_order(scan)) {
    const Eigen::Vector3f& p = scan.points[i];
    points.insert(points.end(), {p.x(), p.y(), p.z(), scan.reflectivity[i]});
    labels.push_back(static_cast<std::uint32_t>(scan.objects[i]) << 16 | scan.labels[i]);
  }
  write(points, labels, T_world_lidar, stamp);
}

void LabelledScanWriter::write(const std::vector<ScanPoint>& points, const SE3& T_world_scan,
                               Time stamp) {
  std::vector<float> values;
  std::vector<std::uint32_t> labels;
  std::vector<std::uint16_t> rings;
  for (const ScanPoint& p : points) {
    values.insert(values.end(), {p.position.x(), p.position.y(), p.position.z(), p.reflectivity});
    labels.push_back(static_cast<std::uint32_t>(p.object) << 16 | p.label);
    rings.push_back(p.ring);
  }
  make_folder(folder_ / "ring");
  write_file(folder_ / "ring" / (name_of_scan(poses_.size()) + ".u16"), rings);
  write(values, labels, T_world_scan, stamp);
}

void LabelledScanWriter::write(const std::vector<float>& points,
                               const std::vector<std::uint32_t>& labels, const SE3& T_world_scan,
                               Time stamp) {
  const std::string name = name_of_scan(poses_.size());
  write_file(folder_ / "velodyne" / (name + ".bin"), points);
  write_file(folder_ / "labels" / (name + ".label"), labels);
  poses_.push_back(T_world_scan);
  times_.push_back(stamp);
}

void LabelledScanWriter::finish() const {
  std::ofstream poses(folder_ / "poses.txt");
  std::ofstream times(folder_ / "times.txt");
  std::ofstream calibration(folder_ / "calib.txt");
  const SE3 T = T_camera_lidar();
  calibration << "Tr: ";
  write_row(calibration, T);
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    write_row(poses, T * poses_.front().inverse() * poses_[i] * T.inverse());
    char time[32];
    std::snprintf(time, sizeof(time), "%.6f", to_seconds(times_[i] - times_.front()));
    times << time << '\n';
  }
  poses.close();
  times.close();
  calibration.close();
  if (!poses || !times || !calibration) throw Error(folder_.string() + ": cannot be written");
}

}  // namespace saker::simulation
