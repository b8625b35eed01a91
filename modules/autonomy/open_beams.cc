#include "saker/autonomy/open_beams.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace saker::autonomy {
namespace {

bool answered(const Eigen::Vector3f& point) { return std::isfinite(point.x()); }

}  // namespace

OpenBeams::OpenBeams(const lidar::SensorInfo& info)
    : rays_(info), shift_(info.pixel_shift_by_row), rows_(info.rows), columns_(info.columns) {}

int OpenBeams::sent_column(int row, int column) const {
  return ((column - shift_[row]) % columns_ + columns_) % columns_;
}

void OpenBeams::find_columns(const lidar::Scan& scan) {
  came_.assign(static_cast<std::size_t>(columns_), false);
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      const std::size_t pixel = static_cast<std::size_t>(row) * columns_ + column;
      if (answered(scan.points[pixel])) came_[sent_column(row, column)] = true;
    }
  }
}

bool OpenBeams::silent_around(const lidar::Scan& scan, int row, int column) const {
  for (int r = std::max(row - 1, 0); r <= std::min(row + 1, rows_ - 1); ++r) {
    for (int step = -1; step <= 1; ++step) {
      const int c = (column + step + columns_) % columns_;
      if (answered(scan.points[static_cast<std::size_t>(r) * columns_ + c])) return false;
    }
  }
  return true;
}

std::vector<Eigen::Vector3f> OpenBeams::added_to(const lidar::Scan& scan) {
  std::vector<Eigen::Vector3f> points = scan.points;
  if (scan.rows != rows_ || scan.columns != columns_) return points;
  find_columns(scan);
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      const std::size_t pixel = static_cast<std::size_t>(row) * columns_ + column;
      if (answered(scan.points[pixel])) continue;
      const int sent = sent_column(row, column);
      if (!came_[sent] || !silent_around(scan, row, column)) continue;
      const lidar::RayTable::Ray& ray = rays_.ray(row, sent);
      points[pixel] = ray.origin + kOpen_m * ray.direction;
    }
  }
  return points;
}

void OpenBeams::drop_steep(std::vector<Eigen::Vector3f>& points, const SE3& T_odom_lidar) {
  const Eigen::Vector3f up = T_odom_lidar.linear().row(2).transpose().cast<float>();
  const double flat = std::sin(kFlat_deg * std::numbers::pi / 180);
  const double down = std::max(flat, T_odom_lidar.translation().z() / kGroundAnswers_m);
  for (Eigen::Vector3f& point : points) {
    if (is_open(point) && -up.dot(point) > down * point.norm()) point.setConstant(NAN);
  }
}

}  // namespace saker::autonomy
