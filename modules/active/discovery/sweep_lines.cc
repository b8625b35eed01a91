#include "saker/active/discovery/sweep_lines.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace saker::active {
namespace {

using Eigen::Vector2d;

Vector2d across(const Vector2d& along) { return {-along.y(), along.x()}; }

struct Extent {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  [[nodiscard]] double width() const { return high - low; }
};

Extent extent(std::span<const Vector2d> corners, const Vector2d& direction) {
  Extent found;
  for (const Vector2d& corner : corners) {
    found.low = std::min(found.low, corner.dot(direction));
    found.high = std::max(found.high, corner.dot(direction));
  }
  return found;
}

/// Of the edges, that across which the polygon is narrowest.
Vector2d direction_of_lines(std::span<const Vector2d> corners) {
  Vector2d best = Vector2d::UnitX();
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector2d edge = corners[(i + 1) % corners.size()] - corners[i];
    if (edge.norm() <= 0) continue;
    const Vector2d along = edge.normalized();
    const double width = extent(corners, across(along)).width();
    if (width >= least) continue;
    least = width;
    best = along;
  }
  return best;
}

/// Where the line at `offset` across enters and leaves the polygon, in turn, m along.
std::vector<double> crossings(std::span<const Vector2d> corners, const Vector2d& along,
                              double offset) {
  std::vector<double> found;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector2d& a = corners[i];
    const Vector2d& b = corners[(i + 1) % corners.size()];
    const double a_off = a.dot(across(along)) - offset, b_off = b.dot(across(along)) - offset;
    if ((a_off > 0) == (b_off > 0)) continue;
    const double t = a_off / (a_off - b_off);
    found.push_back((a + t * (b - a)).dot(along));
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace

std::vector<SweepLine> sweep_lines(std::span<const Vector2d> corners, double spacing_m) {
  const Vector2d along = direction_of_lines(corners);
  const Extent span = extent(corners, across(along));
  const int count = std::max(1, static_cast<int>(std::ceil(span.width() / spacing_m)));
  std::vector<SweepLine> lines;
  for (int i = 0; i < count; ++i) {
    const double offset = span.low + (i + 0.5) * span.width() / count;
    std::vector<double> ends = crossings(corners, along, offset);
    if (i % 2 == 1) std::reverse(ends.begin(), ends.end());
    for (std::size_t k = 0; k + 1 < ends.size(); k += 2) {
      const Vector2d foot = offset * across(along);
      lines.push_back({foot + ends[k] * along, foot + ends[k + 1] * along});
    }
  }
  return lines;
}

std::vector<Vector2d> stops_on(std::span<const SweepLine> lines, double step_m, double inset_m) {
  std::vector<Vector2d> stops;
  for (const SweepLine& line : lines) {
    const double length = (line.to - line.from).norm() - 2 * inset_m;
    if (length <= 0) {
      stops.emplace_back(0.5 * (line.from + line.to));
      continue;
    }
    const Vector2d along = (line.to - line.from).normalized();
    const int steps = static_cast<int>(std::ceil(length / step_m));
    for (int i = 0; i <= steps; ++i) {
      stops.emplace_back(line.from + (inset_m + length * i / steps) * along);
    }
  }
  return stops;
}

}  // namespace saker::active
