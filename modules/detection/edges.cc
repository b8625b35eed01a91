#include "detection/edges.h"

#include <algorithm>
#include <cmath>

namespace saker::detection {
namespace {

/// Of what the edge of a face scatters by that is seen over the vehicle, one that is seen from
/// beside: an outline, which shows the lower part too, but rounded.
constexpr double kOutline = 0.5;

double nearest_range(const Footprint& footprint, const std::vector<Eigen::Vector3d>& sensors) {
  const Eigen::Vector2d x(std::cos(footprint.direction), std::sin(footprint.direction));
  const Eigen::Vector2d middle = 0.5 * (footprint.low + footprint.high);
  const Eigen::Vector2d centre = middle.x() * x + middle.y() * Eigen::Vector2d(-x.y(), x.x());
  double range = 1e3;
  for (const Eigen::Vector3d& sensor : sensors) {
    range = std::min(range, (sensor.head<2>() - centre).norm());
  }
  return range;
}

/// 0 at 0, 1 from 1 on, smooth between.
double smooth_step(double x) {
  const double t = std::min(x, 1.0);
  return t * t * (3 - 2 * t);
}

/// How well the low and the high face across an axis were looked at by the sensor that is farthest
/// outside of each: 0 from beside or over the vehicle … 1.
std::array<double, 2> looked_at(const Footprint& footprint,
                                const std::vector<Eigen::Vector3d>& sensors, int k,
                                const SetbackConfig& config) {
  const double angle = footprint.direction + k * M_PI / 2;
  const Eigen::Vector2d axis(std::cos(angle), std::sin(angle));
  std::array<double, 2> outside{};
  for (const Eigen::Vector3d& sensor : sensors) {
    const double at = axis.dot(sensor.head<2>());
    outside[0] = std::max(outside[0], footprint.low[k] - at);
    outside[1] = std::max(outside[1], at - footprint.high[k]);
  }
  return {smooth_step(outside[0] / config.outside_m), smooth_step(outside[1] / config.outside_m)};
}

/// Where the vehicle would go on beyond an edge.
objects::Cuboid beyond(const Footprint& footprint, int k, int end, const BeyondConfig& config) {
  const int across = 1 - k;
  const double inset = std::min(config.inset_m, 0.25 * footprint.size()[across]);
  std::array<Eigen::Vector2d, 2> plan{footprint.low, footprint.high};
  plan[0][across] += inset;
  plan[1][across] -= inset;
  const double edge = plan[end][k], outward = end == 0 ? -1 : 1;
  plan[end][k] = edge + outward * config.far_m;
  plan[1 - end][k] = edge + outward * config.near_m;
  return upright(footprint.direction, plan, {config.lowest_m, config.highest_m});
}

}  // namespace

Footprint as_seen(const Footprint& footprint, const Sight& sight, const SetbackConfig& config) {
  Footprint seen = footprint;
  for (int k = 0; k < 2; ++k) {
    const auto [low, high] = looked_at(footprint, sight.sensors, k, config);
    seen.low[k] = std::lerp(footprint.outer_low[k] - high * config.mean_m, footprint.low[k], low);
    seen.high[k] =
        std::lerp(footprint.outer_high[k] + low * config.mean_m, footprint.high[k], high);
  }
  return seen;
}

EdgeSds edge_sds(const Footprint& footprint, const Sight& sight, const VehicleNoiseConfig& noise) {
  const double seen_sd =
      std::hypot(noise.edge_m, noise.edge_per_m * nearest_range(footprint, sight.sensors));
  EdgeSds sds{};
  for (int k = 0; k < 2; ++k) {
    const std::array<double, 2> looked = looked_at(footprint, sight.sensors, k, noise.setback);
    for (int end = 0; end < 2; ++end) {
      const int past = sight.through(beyond(footprint, k, end, noise.beyond));
      const double seen = smooth_step(past / noise.beyond.beams);
      const double setback = (1 - looked[end]) * std::lerp(kOutline, 1.0, looked[1 - end]);
      sds[k][end] = seen_sd + setback * noise.setback.sd_m + (1 - seen) * noise.unseen_m;
    }
  }
  return sds;
}

}  // namespace saker::detection
