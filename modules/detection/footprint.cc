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

/// The places along both axes of a direction.
using Along = std::array<std::vector<double>, 2>;
/// How far the strips across an axis reach outward along it, to its low and to its high side.
using Reach = std::array<std::vector<double>, 2>;

constexpr double kNone = -1e9;  // of a strip without places

Along along_both(double direction, const Places& places) {
  const auto axis = axes(direction);
  return {along(axis[0], places), along(axis[1], places)};
}

/// The strip of each place.
std::vector<std::size_t> strips_of(const std::vector<double>& across, double strip_m) {
  const double first = *std::ranges::min_element(across);
  std::vector<std::size_t> strips(across.size());
  std::ranges::transform(across, strips.begin(), [&](double at) {
    return static_cast<std::size_t>((at - first) / strip_m);
  });
  return strips;
}

/// By each strip's outermost place.
Reach outermost(const std::vector<double>& along, const std::vector<std::size_t>& strips) {
  Reach reach;
  reach.fill(std::vector<double>(*std::ranges::max_element(strips) + 1, kNone));
  for (std::size_t i = 0; i < along.size(); ++i) {
    double& low = reach[0][strips[i]];
    double& high = reach[1][strips[i]];
    low = std::max(low, -along[i]);
    high = std::max(high, along[i]);
  }
  return reach;
}

/// By the mean of each strip's outermost layer: of many places on a face the outermost is the one
/// that noise moved farthest.
Reach faces(const std::vector<double>& along, const std::vector<std::size_t>& strips,
            const Reach& outermost, double layer_m) {
  Reach mean = outermost;
  for (int end = 0; end < 2; ++end) {
    std::vector<double> sum(mean[end].size(), 0), count = sum;
    for (std::size_t i = 0; i < along.size(); ++i) {
      const double outward = end == 0 ? -along[i] : along[i];
      if (outward < outermost[end][strips[i]] - layer_m) continue;
      sum[strips[i]] += outward;
      count[strips[i]] += 1;
    }
    for (std::size_t k = 0; k < sum.size(); ++k) {
      if (count[k] > 0) mean[end][k] = sum[k] / count[k];
    }
  }
  return mean;
}

/// Without strips that have no place.
Reach filled(Reach reach) {
  for (std::vector<double>& side : reach) std::erase(side, kNone);
  return reach;
}

/// How far outward a side lies: where most strips reach to, of those no farther out than the
/// outermost that lie together.
double side_of(std::vector<double> outward, const FootprintConfig& config) {
  std::ranges::sort(outward);
  const double share = config.together_share * static_cast<double>(outward.size());
  const auto least = std::max<std::size_t>(2, static_cast<std::size_t>(std::ceil(share)));
  for (std::size_t n = outward.size(); n >= least; --n) {
    if (outward[n - 1] - outward[n - least] > config.together_m) continue;
    outward.resize(n);
    break;
  }
  return core::percentile(outward, config.reach_percentile / 100);
}

/// Zhang et al., eq. 5, with the sides where most of all strips reach to; a point beyond a side is
/// as close as one within. Smooth at a side, so that of points which all lie near one still the
/// closest direction wins.
double closeness(const Along& places, const FootprintConfig& config) {
  std::array<std::array<double, 2>, 2> sides{};  // [axis][low, high], outward
  for (std::size_t k = 0; k < 2; ++k) {
    const Reach reach = filled(outermost(places[k], strips_of(places[1 - k], config.strip_m)));
    for (std::size_t end = 0; end < 2; ++end) {
      sides[k][end] = core::percentile(reach[end], config.reach_percentile / 100);
    }
  }
  double score = 0;
  for (std::size_t i = 0; i < places[0].size(); ++i) {
    double nearest = 1e9;
    for (std::size_t k = 0; k < 2; ++k) {
      const double at = places[k][i];
      nearest = std::min({nearest, std::abs(at + sides[k][0]), std::abs(sides[k][1] - at)});
    }
    score += 1 / std::hypot(nearest, config.side_m);
  }
  return score;
}

double closest_direction(const Places& places, const FootprintConfig& config) {
  double best = 0, best_score = -1;
  for (double degrees = 0; degrees < 90; degrees += config.step_deg) {
    const double direction = degrees * M_PI / 180;
    const double score = closeness(along_both(direction, places), config);
    if (score <= best_score) continue;
    best_score = score;
    best = direction;
  }
  return best;
}

Footprint sides(const Places& places, const FootprintConfig& config) {
  Footprint footprint;
  footprint.direction = closest_direction(places, config);
  const Along at = along_both(footprint.direction, places);
  for (int k = 0; k < 2; ++k) {
    const std::vector<std::size_t> strips = strips_of(at[1 - k], config.strip_m);
    const Reach farthest = outermost(at[k], strips);
    const auto [low, high] = filled(faces(at[k], strips, farthest, config.layer_m));
    footprint.low[k] = -side_of(low, config);
    footprint.high[k] = side_of(high, config);
    const auto [outer_low, outer_high] = filled(farthest);
    footprint.outer_low[k] = -core::percentile(outer_low, config.outer_percentile / 100);
    footprint.outer_high[k] = core::percentile(outer_high, config.outer_percentile / 100);
  }
  return footprint;
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
