#include "saker/autonomy/open_beams.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "saker/occupancy/open_beam.h"

namespace saker::autonomy {
namespace {

bool answered(const Eigen::Vector3f& point) { return std::isfinite(point.x()); }

}  // namespace

OpenBeams::OpenBeams(const lidar::SensorInfo& info)
    : rays_(info), shift_(info.pixel_shift_by_row), rows_(info.rows), columns_(info.columns) {
  for (int row = 0; row < rows_; ++row)
    elevation_.push_back(std::asin(std::clamp(rays_.ray(row, 0).direction.z(), -1.0F, 1.0F)));
  silent_.resize(pixel(rows_, 0));
  gaps_.resize(pixel(rows_, 0));
}

int OpenBeams::sent_column(int row, int column) const {
  return ((column - shift_[row]) % columns_ + columns_) % columns_;
}

void OpenBeams::find_columns(const lidar::Scan& scan) {
  came_.assign(static_cast<std::size_t>(columns_), false);
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      if (answered(scan.points[pixel(row, column)])) came_[sent_column(row, column)] = true;
    }
  }
}

void OpenBeams::find_silent(const lidar::Scan& scan) {
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      silent_[pixel(row, column)] =
          !answered(scan.points[pixel(row, column)]) && came_[sent_column(row, column)];
    }
  }
}

/// Columns go round: twice along a row, so that a gap across the seam is one.
void OpenBeams::find_gaps() {
  for (int row = 0; row < rows_; ++row) {
    int left = 0, right = 0;
    for (int k = 0; k < 2 * columns_; ++k) {
      const int from_left = k % columns_, from_right = columns_ - 1 - from_left;
      gaps_[pixel(row, from_left)].left = left;
      gaps_[pixel(row, from_right)].right = right;
      left = silent_[pixel(row, from_left)] ? std::min(left + 1, columns_) : 0;
      right = silent_[pixel(row, from_right)] ? std::min(right + 1, columns_) : 0;
    }
  }
  for (int column = 0; column < columns_; ++column) {
    int up = 0, down = 0;
    for (int row = 0; row < rows_; ++row) {
      const int from_below = rows_ - 1 - row;
      gaps_[pixel(row, column)].up = up;
      gaps_[pixel(from_below, column)].down = down;
      up = silent_[pixel(row, column)] ? up + 1 : 0;
      down = silent_[pixel(from_below, column)] ? down + 1 : 0;
    }
  }
}

bool OpenBeams::silent_around(int row, int column) const {
  for (int r = std::max(row - 1, 0); r <= std::min(row + 1, rows_ - 1); ++r) {
    for (int step = -1; step <= 1; ++step) {
      if (!silent_[pixel(r, (column + step + columns_) % columns_)]) return false;
    }
  }
  return true;
}

float OpenBeams::clears_from_m(int row, const Gap& gap) const {
  constexpr auto kHalfTurn = std::numbers::pi_v<float>;
  const float column_rad = 2 * kHalfTurn / static_cast<float>(columns_);
  const float left = column_rad * static_cast<float>(gap.left);
  const float right = column_rad * static_cast<float>(gap.right);
  if (left + right >= kHalfTurn) return 0;  // no plane is seen over so much
  const auto reach = [](float angle) { return std::sin(std::min(angle, kHalfTurn / 2)); };
  const float across = (reach(left) + reach(right)) * std::cos(elevation_[row]);
  const float upright = reach(std::abs(elevation_[row - gap.up] - elevation_[row])) +
                        reach(std::abs(elevation_[row + gap.down] - elevation_[row]));
  return std::min(kNarrowest_m / std::min(across, upright), kLongest_m / std::max(across, upright));
}

std::vector<Eigen::Vector3f> OpenBeams::added_to(const lidar::Scan& scan) {
  std::vector<Eigen::Vector3f> points = scan.points;
  if (scan.rows != rows_ || scan.columns != columns_) return points;
  find_columns(scan);
  find_silent(scan);
  find_gaps();
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      if (!silent_[pixel(row, column)] || !silent_around(row, column)) continue;
      const float from_m = clears_from_m(row, gaps_[pixel(row, column)]);
      if (!(from_m < kNoUse_m)) continue;
      const lidar::RayTable::Ray& ray = rays_.ray(row, sent_column(row, column));
      points[pixel(row, column)] = ray.origin + (occupancy::kOpenBeam_m + from_m) * ray.direction;
    }
  }
  return points;
}

void OpenBeams::drop_steep(std::vector<Eigen::Vector3f>& points, const SE3& T_odom_lidar) {
  const Eigen::Vector3f up = T_odom_lidar.linear().row(2).transpose().cast<float>();
  const double flat = std::sin(kFlat_deg * std::numbers::pi / 180);
  const double down = std::max(flat, T_odom_lidar.translation().z() / kGroundAnswers_m);
  for (Eigen::Vector3f& point : points) {
    if (occupancy::is_open_beam(point) && -up.dot(point) > down * point.norm())
      point.setConstant(NAN);
  }
}

}  // namespace saker::autonomy
