#include "detection/edges.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace saker::detection {
namespace {

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

/// Where the vehicle would go on beyond an edge; its x axis points outward.
objects::Cuboid beyond(const Footprint& footprint, int k, int end, const BeyondConfig& config) {
  const int across = 1 - k, sign = end == 0 ? -1 : 1;
  const double edge = sign * (end == 0 ? footprint.low[k] : footprint.high[k]);
  const double inset = std::min(config.inset_m, 0.25 * footprint.size()[across]);
  const Eigen::Vector2d sides(footprint.low[across] + inset, footprint.high[across] - inset);
  const bool same_way = (k == 0) == (end == 1);  // a quarter turn from outward is +across
  const double low = same_way ? sides[0] : -sides[1], high = same_way ? sides[1] : -sides[0];
  const double outward = footprint.direction + k * M_PI / 2 + (end == 0 ? M_PI : 0);
  return upright(outward, {Eigen::Vector2d(edge + config.near_m, low), {edge + config.far_m, high}},
                 {config.lowest_m, config.highest_m});
}

/// From how far beyond an edge and its noise (`near_m`) on space is seen to be free; infinite where
/// it is not seen.
double free_from(const Footprint& footprint, int k, int end, const Sight& sight,
                 const BeyondConfig& config) {
  const objects::Cuboid box = beyond(footprint, k, end, config);
  double least_way_m = config.least_way_m;
  // Where one face alone was seen, a side is thin. An end is not: corners are rounded.
  if (k == 1) least_way_m = std::min(least_way_m, 0.5 * box.size.y());
  return sight.nearest(box, config.beams, least_way_m);
}

/// Of its shadow, at which an end as high as `top` lies where the other one is as high as `other`.
double place_in_shadow(double top, double other, const ShadowConfig& config) {
  const double front = std::clamp(0.5 + 0.5 * (other - top) / config.apart_m, 0.0, 1.0);
  const double of_front = std::clamp(config.place - config.place_per_m * (top - config.bonnet_m),
                                     config.least_place, 1.0);
  return std::lerp(config.least_place, of_front, front);
}

/// Lower than its windows.
objects::Cuboid inner_part(const Footprint& footprint, const GapConfig& gap) {
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(gap.inset_m);
  return upright(footprint.direction, {footprint.low + margin, footprint.high - margin},
                 {gap.lowest_m, gap.highest_m});
}

/// Upright along the low or the high side, between distances inward from it and along its middle.
objects::Cuboid along_side(const Footprint& footprint, int side, const Eigen::Vector2d& inward,
                           const Eigen::Vector2d& along, const GapConfig& gap) {
  const double middle = 0.5 * (footprint.low.x() + footprint.high.x());
  const Eigen::Vector2d across =
      side == 0 ? Eigen::Vector2d(footprint.low.y() + inward[0], footprint.low.y() + inward[1])
                : Eigen::Vector2d(footprint.high.y() - inward[1], footprint.high.y() - inward[0]);
  return upright(footprint.direction,
                 {Eigen::Vector2d(middle + along[0], across[0]), {middle + along[1], across[1]}},
                 {gap.lowest_m, gap.highest_m});
}

/// Whether somewhere in its middle nothing was met on a side, but beams went on behind it.
bool open(const Footprint& footprint, int side, const Sight& sight, const GapConfig& gap) {
  const Eigen::Vector2d face(-gap.side_inset_m, gap.side_inset_m);
  const Eigen::Vector2d behind(gap.side_inset_m, gap.side_inset_m + gap.side_depth_m);
  const double half = 0.5 * gap.side_share * footprint.size().x();
  const auto enter = [&](const Eigen::Vector2d& along) {
    return sight.through(along_side(footprint, side, behind, along, gap)) >= gap.beams;
  };
  if (!enter({-half, half})) return false;
  for (double at = -half; at + gap.strip_m <= half; at += 0.5 * gap.strip_m) {
    const Eigen::Vector2d strip(at, at + gap.strip_m);
    const bool met = sight.filled(along_side(footprint, side, face, strip, gap), 1, 1) > 0;
    if (!met && enter(strip)) return true;
  }
  return false;
}

}  // namespace

bool parted(const Footprint& footprint, const Sight& sight, const VehicleConfig& config) {
  const GapConfig& gap = config.gap;
  if (sight.through(inner_part(footprint, gap)) >= gap.beams) return true;
  if (footprint.size().x() < 2 * config.width_m) return false;  // the widths of two
  const auto looked = looked_at(footprint, sight.sensors, 1, config.noise.setback);
  for (int side = 0; side < 2; ++side) {
    if (looked[side] > config.footprint.looked_at && open(footprint, side, sight, gap)) return true;
  }
  return false;
}

std::vector<Eigen::Vector2d> within(const Footprint& footprint,
                                    const std::vector<Eigen::Vector2d>& places, const Sight& sight,
                                    const VehicleConfig& config) {
  const double least = config.footprint.looked_at;
  const Eigen::Rotation2Dd to_axes(-footprint.direction);
  Eigen::Vector2d low = Eigen::Vector2d::Constant(-1e9), high = -low;
  for (int k = 0; k < 2; ++k) {
    const auto looked = looked_at(footprint, sight.sensors, k, config.noise.setback);
    const double out = config.footprint.stands_out_m;
    if (looked[0] > least) low[k] = footprint.low[k] - out;
    if (looked[1] > least) high[k] = footprint.high[k] + out;
  }
  std::vector<Eigen::Vector2d> kept;
  std::ranges::copy_if(places, std::back_inserter(kept), [&](const Eigen::Vector2d& place) {
    const Eigen::Vector2d at = to_axes * place;
    return (at.array() >= low.array()).all() && (at.array() <= high.array()).all();
  });
  return kept;
}

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

Edges edges_of(const Footprint& footprint, const std::array<double, 2>& tops, const Sight& sight,
               const VehicleNoiseConfig& noise) {
  const double seen_sd =
      std::hypot(noise.edge_m, noise.edge_per_m * nearest_range(footprint, sight.sensors));
  Edges edges{};
  for (int k = 0; k < 2; ++k) {
    const std::array<double, 2> looked = looked_at(footprint, sight.sensors, k, noise.setback);
    for (int end = 0; end < 2; ++end) {
      FootprintEdge& edge = edges[k][end];
      edge.hidden_m = free_from(footprint, k, end, sight, noise.beyond);
      double way = edge.hidden_m, outward = 0;
      if (k == 0 && std::isfinite(way)) {
        const ShadowConfig& shadow = noise.beyond.shadow;
        outward = (1 - looked[end]) * place_in_shadow(tops[end], tops[1 - end], shadow) * way;
        way *= std::lerp(shadow.spread, 1.0, looked[end]);
      }
      const double setback =
          (1 - looked[end]) * std::lerp(noise.setback.outline, 1.0, looked[1 - end]);
      edge.position = end == 0 ? footprint.low[k] - outward : footprint.high[k] + outward;
      edge.sd =
          seen_sd + setback * noise.setback.sd_m + std::min(way / std::sqrt(12.0), noise.unseen_m);
    }
  }
  return edges;
}

}  // namespace saker::detection
