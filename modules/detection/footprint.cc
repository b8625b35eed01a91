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

using Places = std::vector<Eigen::Vector2d>;

std::vector<double> along(const Eigen::Vector2d& axis, const Places& places) {
  std::vector<double> values(places.size());
  std::transform(places.begin(), places.end(), values.begin(),
                 [&](const Eigen::Vector2d& p) { return axis.dot(p); });
  return values;
}

Footprint percentiles(const Places& hull, double direction, const FootprintConfig& config) {
  Footprint footprint;
  footprint.direction = direction;
  const auto axis = axes(direction);
  for (int k = 0; k < 2; ++k) {
    const std::vector<double> values = along(axis[k], hull);
    footprint.low[k] = core::percentile(values, config.low_percentile / 100);
    footprint.high[k] = core::percentile(values, config.high_percentile / 100);
  }
  footprint.outer_low = footprint.low;
  footprint.outer_high = footprint.high;
  return footprint;
}

/// How far the strips across an axis reach along it.
struct Reach {
  std::vector<double> low, high;
};

Reach reach(const std::vector<double>& along, const std::vector<double>& across, double strip_m) {
  constexpr double kNone = 1e9;
  const auto [first, last] = std::minmax_element(across.begin(), across.end());
  const auto strip = [&](double at) { return static_cast<std::size_t>((at - *first) / strip_m); };
  Reach reach{std::vector<double>(strip(*last) + 1, kNone), {}};
  reach.high.assign(reach.low.size(), -kNone);
  for (std::size_t i = 0; i < along.size(); ++i) {
    double& low = reach.low[strip(across[i])];
    double& high = reach.high[strip(across[i])];
    low = std::min(low, along[i]);
    high = std::max(high, along[i]);
  }
  std::erase(reach.low, kNone);
  std::erase(reach.high, -kNone);
  return reach;
}

/// Zhang et al., eq. 5, with the sides where most strips reach to; a point beyond a side is as
/// close as one within. Smooth at a side, so that of points which all lie near one still the
/// closest direction wins.
double closeness(const std::array<std::vector<double>, 2>& values, const Footprint& footprint,
                 double side) {
  double score = 0;
  for (std::size_t i = 0; i < values[0].size(); ++i) {
    double nearest = 1e9;
    for (int k = 0; k < 2; ++k) {
      const double at = values[static_cast<std::size_t>(k)][i];
      nearest =
          std::min({nearest, std::abs(at - footprint.low[k]), std::abs(footprint.high[k] - at)});
    }
    score += 1 / std::hypot(nearest, side);
  }
  return score;
}

Footprint sides(const Places& places, const FootprintConfig& config) {
  Footprint best;
  double best_score = -1;
  for (double degrees = 0; degrees < 90; degrees += config.step_deg) {
    Footprint footprint;
    footprint.direction = degrees * M_PI / 180;
    const auto axis = axes(footprint.direction);
    const std::array<std::vector<double>, 2> values = {along(axis[0], places),
                                                       along(axis[1], places)};
    for (std::size_t k = 0; k < 2; ++k) {
      const Reach strips = reach(values[k], values[1 - k], config.strip_m);
      const auto i = static_cast<Eigen::Index>(k);
      footprint.low[i] = core::percentile(strips.low, 1 - config.reach_percentile / 100);
      footprint.high[i] = core::percentile(strips.high, config.reach_percentile / 100);
      footprint.outer_low[i] = core::percentile(strips.low, 1 - config.outer_percentile / 100);
      footprint.outer_high[i] = core::percentile(strips.high, config.outer_percentile / 100);
    }
    const double score = closeness(values, footprint, config.side_m);
    if (score <= best_score) continue;
    best_score = score;
    best = footprint;
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

Footprint turned(const Footprint& footprint) {
  return {footprint.direction + M_PI / 2,
          {footprint.low.y(), -footprint.high.x()},
          {footprint.high.y(), -footprint.low.x()},
          {footprint.outer_low.y(), -footprint.outer_high.x()},
          {footprint.outer_high.y(), -footprint.outer_low.x()}};
}

Footprint fit_footprint(const std::vector<Eigen::Vector2d>& points, const FootprintConfig& config) {
  if (points.empty()) return {};
  if (config.method == FootprintMethod::hull) {
    const Places hull = convex_hull(points);
    return percentiles(hull, principal_direction(hull), config);
  }
  const Footprint footprint = sides(points, config);
  return footprint.size().x() >= footprint.size().y() ? footprint : turned(footprint);
}

}  // namespace saker::detection
