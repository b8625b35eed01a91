#include "detection/footprint.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/statistics.h"
#include "detection/hull.h"

namespace saker::detection {
namespace {

std::array<Eigen::Vector2d, 2> axes(double direction) {
  const double c = std::cos(direction);
  const double s = std::sin(direction);
  return {Eigen::Vector2d(c, s), Eigen::Vector2d(-s, c)};
}

Footprint extents(const std::vector<Eigen::Vector2d>& hull, double direction,
                  const FootprintConfig& config) {
  Footprint footprint;
  footprint.direction = direction;
  const auto axis = axes(direction);
  std::vector<double> along(hull.size());
  for (int k = 0; k < 2; ++k) {
    std::transform(hull.begin(), hull.end(), along.begin(),
                   [&](const Eigen::Vector2d& p) { return axis[k].dot(p); });
    footprint.low[k] = core::percentile(along, config.low_percentile / 100);
    footprint.high[k] = core::percentile(along, config.high_percentile / 100);
  }
  return footprint;
}

/// Zhang et al., eq. 5, with the sides at the hull's percentiles; a point beyond a side is as
/// close as one within.
double closeness(const std::vector<Eigen::Vector2d>& points, const Footprint& footprint,
                 double side) {
  const auto axis = axes(footprint.direction);
  double score = 0;
  for (const Eigen::Vector2d& p : points) {
    double nearest = 1e9;
    for (int k = 0; k < 2; ++k) {
      const double at = axis[k].dot(p);
      nearest =
          std::min({nearest, std::abs(at - footprint.low[k]), std::abs(footprint.high[k] - at)});
    }
    score += 1 / std::max(nearest, side);
  }
  return score;
}

double closest_direction(const std::vector<Eigen::Vector2d>& points,
                         const std::vector<Eigen::Vector2d>& hull, const FootprintConfig& config) {
  double best = 0;
  double best_score = -1;
  for (double degrees = 0; degrees < 90; degrees += config.step_deg) {
    const double direction = degrees * M_PI / 180;
    const double score = closeness(points, extents(hull, direction, config), config.side_m);
    if (score <= best_score) continue;
    best_score = score;
    best = direction;
  }
  return best;
}

}  // namespace

objects::Cuboid upright(double direction, const std::array<Eigen::Vector2d, 2>& plan,
                        const std::array<double, 2>& height) {
  const Eigen::Vector3d low(plan[0].x(), plan[0].y(), height[0]);
  const Eigen::Vector3d high(plan[1].x(), plan[1].y(), height[1]);
  objects::Cuboid box;
  box.pose.linear() = Eigen::AngleAxisd(direction, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  box.pose.translation() = box.pose.linear() * (0.5 * (low + high));
  box.size = high - low;
  return box;
}

Footprint fit_footprint(const std::vector<Eigen::Vector2d>& points, const FootprintConfig& config) {
  const std::vector<Eigen::Vector2d> hull = convex_hull(points);
  if (hull.empty()) return {};
  if (config.axis == AxisMethod::pca) return extents(hull, principal_direction(hull), config);
  const Footprint footprint = extents(hull, closest_direction(points, hull, config), config);
  if (footprint.size().x() >= footprint.size().y()) return footprint;
  return extents(hull, footprint.direction + M_PI / 2, config);
}

}  // namespace saker::detection
