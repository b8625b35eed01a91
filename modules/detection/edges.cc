#include "detection/edges.h"

#include <algorithm>
#include <cmath>

namespace saker::detection {
namespace {

/// Of what a far face's edge scatters by, an outline's: it shows the lower part too, but rounded.
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

/// How well a face was looked at by the sensor that is farthest outside of it: 0 from beside or
/// behind … 1.
double looked_at(const Footprint& footprint, const std::vector<Eigen::Vector3d>& sensors, int k,
                 int end, const SetbackConfig& config) {
  const double angle = footprint.direction + k * M_PI / 2;
  const Eigen::Vector2d axis(std::cos(angle), std::sin(angle));
  double outside = 0;
  for (const Eigen::Vector3d& sensor : sensors) {
    const double at = axis.dot(sensor.head<2>());
    outside = std::max(outside, end == 0 ? footprint.low[k] - at : at - footprint.high[k]);
  }
  return smooth_step(outside / config.outside_m);
}

/// The two ways of not looking at a face, each 0 … 1: over the vehicle from the far side, and from
/// beside it, where its edge is an outline.
struct NotLookedAt {
  double over, beside;

  NotLookedAt(const Footprint& footprint, const std::vector<Eigen::Vector3d>& sensors, int k,
              int end, const SetbackConfig& config) {
    const double own = looked_at(footprint, sensors, k, end, config);
    const double far_side = looked_at(footprint, sensors, k, 1 - end, config);
    over = (1 - own) * far_side;
    beside = (1 - own) * (1 - far_side);
  }
};

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
    const NotLookedAt low(footprint, sight.sensors, k, 0, config);
    const NotLookedAt high(footprint, sight.sensors, k, 1, config);
    seen.low[k] = std::lerp(footprint.low[k], footprint.outer_low[k], low.over + low.beside) -
                  low.over * config.mean_m;
    seen.high[k] = std::lerp(footprint.high[k], footprint.outer_high[k], high.over + high.beside) +
                   high.over * config.mean_m;
  }
  return seen;
}

EdgeSds edge_sds(const Footprint& footprint, const Sight& sight, const VehicleNoiseConfig& noise) {
  const double seen_sd =
      std::hypot(noise.edge_m, noise.edge_per_m * nearest_range(footprint, sight.sensors));
  EdgeSds sds{};
  for (int k = 0; k < 2; ++k) {
    for (int end = 0; end < 2; ++end) {
      const int past = sight.through(beyond(footprint, k, end, noise.beyond));
      const double seen = smooth_step(past / noise.beyond.beams);
      const NotLookedAt not_looked_at(footprint, sight.sensors, k, end, noise.setback);
      const double setback = not_looked_at.over + kOutline * not_looked_at.beside;
      sds[k][end] = seen_sd + setback * noise.setback.sd_m + (1 - seen) * noise.unseen_m;
    }
  }
  return sds;
}

}  // namespace saker::detection
