#include "detection/vehicle.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>

#include "core/statistics.h"
#include "detection/edges.h"
#include "detection/hull.h"

namespace saker::detection {
namespace {

using Places = std::vector<Eigen::Vector2d>;

/// The first point of each small square: what lies dense counts once.
Places thinned(const std::vector<BodyPoint>& points, const Eigen::Vector2d& velocity, double edge) {
  Places places;
  std::vector<std::pair<std::int64_t, std::size_t>> keys;
  places.reserve(points.size());
  for (const BodyPoint& p : points) {
    const Eigen::Vector2d place =
        p.position.head<2>().cast<double>() - velocity * static_cast<double>(p.seconds);
    keys.emplace_back((static_cast<std::int64_t>(std::floor(place.x() / edge)) << 32) +
                          static_cast<std::int64_t>(std::floor(place.y() / edge)),
                      places.size());
    places.push_back(place);
  }
  std::sort(keys.begin(), keys.end());
  Places thin;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (i == 0 || keys[i].first != keys[i - 1].first) thin.push_back(places[keys[i].second]);
  }
  return thin;
}

Motion motion_of(const std::vector<BodyPoint>& points, const VehicleConfig& config) {
  std::vector<TimedPoint> timed;
  timed.reserve(points.size());
  for (const BodyPoint& p : points) timed.push_back({p.position.head<2>(), p.seconds});
  const Places hull = convex_hull(thinned(points, Eigen::Vector2d::Zero(), config.motion.square_m));
  return estimate_motion(timed, principal_direction(hull), config.motion);
}

double top_of(const std::vector<BodyPoint>& points, double percentile) {
  std::vector<double> heights;
  heights.reserve(points.size());
  for (const BodyPoint& p : points) heights.push_back(p.position.z());
  return core::percentile(heights, percentile / 100);
}

/// Of the length (axis 0) or the width of a vehicle with this top (m above the ground).
SizePrior prior_of(int axis, double top, const VehicleConfig& config) {
  const TallConfig& tall = config.tall;
  const double higher = std::clamp(top, tall.from_m, tall.most_m) - tall.from_m;
  if (axis == 1) return {config.width_m + tall.width_per_m * higher, config.width_sd_m};
  return {config.length_m + tall.length_per_m * higher, config.length_sd_m};
}

/// Both axes' edges, given which of them is the length.
struct Rectangle {
  Footprint footprint;
  std::array<Interval, 2> axis;
  double cost = 0;  ///< how unlikely these sizes are, in units of −2 log likelihood
};

/// What is shorter than nearly all of its class was cut, by something in front or by a gap in the
/// labels: either end may be farther out by as much. What is longer than any holds something that
/// stands at one of its ends, which may be farther in by as much.
double unlikely_by(double size, const SizePrior& prior) {
  constexpr double kNearlyAll = 2, kAny = 3;  // standard deviations
  const double shortest = prior.mean - kNearlyAll * prior.sd;
  const double longest = prior.mean + kAny * prior.sd;
  return std::max({0.0, shortest - size, size - longest});
}

/// What is hidden makes nothing longer than its class, and no short thing unlikely.
double unlike(double size, double hidden_m, const SizePrior& prior) {
  return size > prior.mean ? size - prior.mean : std::max(0.0, prior.mean - size - hidden_m);
}

/// A slab across the low or the high end of the footprint's first axis, to `inward` from it.
objects::Cuboid end_of(const Footprint& footprint, int end, double inward,
                       const VehicleConfig& config) {
  const double outward = config.noise.beyond.near_m;
  Eigen::Vector2d low = footprint.low, high = footprint.high;
  const double at = end == 0 ? low.x() : high.x();
  low.x() = end == 0 ? at - outward : at - inward;
  high.x() = end == 0 ? at + inward : at + outward;
  return upright(footprint.direction, {low, high}, {config.lowest_m, config.highest_m});
}

/// Those of the points that lie over or under the slab.
std::vector<BodyPoint> points_of(const objects::Cuboid& end, const std::vector<BodyPoint>& points) {
  const SE3 T_end_local = end.pose.inverse();
  const Eigen::Vector2d half = 0.5 * end.size.head<2>();
  std::vector<BodyPoint> own;
  std::ranges::copy_if(points, std::back_inserter(own), [&](const BodyPoint& p) {
    const Eigen::Vector3d at = T_end_local * p.position.cast<double>();
    return std::abs(at.x()) < half.x() && std::abs(at.y()) < half.y();
  });
  return own;
}

/// How high what was seen of the low and of the high end is; 0 where nothing was.
std::array<double, 2> tops_of_ends(const Footprint& footprint, const std::vector<BodyPoint>& points,
                                   const VehicleConfig& config) {
  const ShadowConfig& shadow = config.noise.beyond.shadow;
  std::array<double, 2> tops{};
  for (int end = 0; end < 2; ++end) {
    const auto own = points_of(end_of(footprint, end, shadow.depth_m, config), points);
    if (!own.empty()) tops[end] = top_of(own, shadow.top_percentile);
  }
  return tops;
}

/// Added to the sd of an end where most of the points about it are of no object; own ones that may
/// be of none do not count. Not to a side's: sides err no more there.
double doubt_amid_others(const std::vector<BodyPoint>& points, const objects::Cuboid& end,
                         const Sight& sight, const AmidOthersConfig& config) {
  const auto own = std::ranges::count_if(points_of(end, points), [&](const BodyPoint& p) {
    return p.probability >= config.sure_probability;
  });
  const double others = sight.others(end);
  return others > config.share * (others + static_cast<double>(own)) ? config.sd_m : 0;
}

/// Along the line of the low or the high side, beyond an end.
objects::Cuboid strip_beyond(const Footprint& footprint, int end, int side,
                             const GoesOnConfig& config) {
  const double reach = config.steps() * config.step_m;
  const double from =
      end == 0 ? footprint.low.x() - config.near_m - reach : footprint.high.x() + config.near_m;
  const double at = side == 0 ? footprint.low.y() : footprint.high.y();
  return upright(footprint.direction,
                 {Eigen::Vector2d(from, at - config.aside_m), {from + reach, at + config.aside_m}},
                 {config.lowest_m, config.highest_m});
}

/// Added to the sd of an end beyond which one of the sides goes on in its line, whatever its points
/// are taken for: something hid a part of it, or its labels are wrong.
double doubt_where_side_goes_on(const Footprint& footprint, int end, const Sight& sight,
                                const GoesOnConfig& config) {
  for (int side = 0; side < 2; ++side) {
    const objects::Cuboid strip = strip_beyond(footprint, end, side, config);
    const int filled = sight.filled(strip, config.steps(), config.beams);
    if (filled >= config.share * config.steps()) return config.sd_m;
  }
  return 0;
}

Rectangle rectangle(const Footprint& footprint, const std::vector<BodyPoint>& points, double top,
                    const Sight& sight, const VehicleConfig& config) {
  Rectangle result{footprint, {}, 0};
  Edges edges = edges_of(footprint, tops_of_ends(footprint, points, config), sight, config.noise);
  for (int end = 0; end < 2; ++end) {
    edges[0][end].sd +=
        doubt_where_side_goes_on(footprint, end, sight, config.noise.goes_on) +
        doubt_amid_others(points, end_of(footprint, end, config.noise.amid_others.depth_m, config),
                          sight, config.noise.amid_others);
  }
  const double seen_sd = config.noise.edge_m + 0.3 * config.noise.unseen_m;
  for (int k = 0; k < 2; ++k) {
    const SizePrior prior = prior_of(k, top, config);
    auto [low, high] = edges[k];
    const double size = footprint.size()[k];
    const double variance = std::pow(prior.sd, 2) + std::pow(low.sd, 2) + std::pow(high.sd, 2);
    result.cost += std::pow(unlike(size, low.hidden_m + high.hidden_m, prior), 2) / variance +
                   std::log(variance);
    const double doubt = unlikely_by(size, prior);
    low.sd += doubt;
    high.sd += doubt;
    result.axis[k] = fuse_edges(low, high, prior, seen_sd);
    const SizePrior shared = {prior.mean, prior.sd * std::sqrt(config.prior_windows)};
    result.axis[k].covariance = fuse_edges(low, high, shared, seen_sd).covariance;
  }
  return result;
}

/// Low and high edge of a rectangle along an axis of one that it lies across.
Eigen::Vector2d edges_along(const Rectangle& across, const Footprint& other, int axis) {
  const Interval& along = across.axis[1 - axis];
  const bool opposite = (std::sin(across.footprint.direction - other.direction) > 0) == (axis == 0);
  return opposite ? Eigen::Vector2d(-along.high, -along.low)
                  : Eigen::Vector2d(along.low, along.high);
}

/// With the odds that the heading is the other's: how far its edges lie from the ones stated.
Rectangle widened_to(const Rectangle& across, Rectangle result, const VehicleConfig& config) {
  const double odds = std::exp((result.cost - across.cost) / config.heading_cost);
  const double probability = odds / (1 + odds);
  for (int axis = 0; axis < 2; ++axis) {
    Interval& stated = result.axis[axis];
    const Eigen::Vector2d off =
        edges_along(across, result.footprint, axis) - Eigen::Vector2d(stated.low, stated.high);
    stated.covariance += of_centre_and_size(probability * off * off.transpose());
  }
  return result;
}

/// The side that is longer need not be the length where one face alone was seen.
Rectangle likelier(const Footprint& footprint, const std::vector<BodyPoint>& points, double top,
                   const Sight& sight, const VehicleConfig& config) {
  const Rectangle straight = rectangle(footprint, points, top, sight, config);
  const Rectangle across = rectangle(turned(footprint), points, top, sight, config);
  return across.cost < straight.cost ? widened_to(straight, across, config)
                                     : widened_to(across, straight, config);
}

/// Log-odds that the lower axis end … the end at +x is the front: the lower one (paper, III-A).
double front_log_odds(const std::vector<BodyPoint>& points, const Motion& motion,
                      const Rectangle& r, const VehicleConfig& config) {
  const Eigen::Vector2d x(std::cos(r.footprint.direction), std::sin(r.footprint.direction));
  std::vector<double> front;
  std::vector<double> rear;
  for (const BodyPoint& p : points) {
    const double at = x.dot(p.position.head<2>().cast<double>() -
                            motion.velocity * static_cast<double>(p.seconds));
    const double ratio = (at - r.axis[0].low) / r.axis[0].size();
    if (ratio < 0.25) rear.push_back(p.position.z());
    if (ratio > 0.75) front.push_back(p.position.z());
  }
  constexpr std::size_t kLeast = 8;
  if (front.size() < kLeast || rear.size() < kLeast) return 0;
  const double rise = core::percentile(rear, 0.9) - core::percentile(front, 0.9);
  const double most = config.most_front_log_odds;
  return std::clamp(rise / config.front_sd_m, -most, most);
}

objects::Cuboid cuboid_of(const Rectangle& r, double top) {
  objects::Cuboid cuboid;
  const Eigen::Matrix3d R =
      Eigen::AngleAxisd(r.footprint.direction, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  cuboid.pose.linear() = R;
  cuboid.pose.translation() =
      R * Eigen::Vector3d(r.axis[0].centre(), r.axis[1].centre(), 0.5 * top);
  cuboid.size = {r.axis[0].size(), r.axis[1].size(), top};
  return cuboid;
}

/// [rotation, translation, size] in the cuboid's own frame.
Matrix9d covariance_of(const Rectangle& r, const VehicleNoiseConfig& noise) {
  Matrix9d P = Matrix9d::Zero();
  const double tilt = noise.tilt_deg * M_PI / 180;
  // An edge that is off turns the heading by its error over the seen length.
  const double seen = std::max(r.footprint.size().maxCoeff(), 0.5);
  const double yaw = std::hypot(noise.yaw_deg * M_PI / 180, 0.7 * noise.edge_m / seen);
  P.diagonal().head<3>() << tilt * tilt, tilt * tilt, yaw * yaw;
  for (int k = 0; k < 2; ++k) {
    P(3 + k, 3 + k) = r.axis[k].covariance(0, 0);
    P(6 + k, 6 + k) = r.axis[k].covariance(1, 1);
    P(3 + k, 6 + k) = P(6 + k, 3 + k) = r.axis[k].covariance(0, 1);
  }
  const double bottom = noise.ground_m * noise.ground_m;
  const double top = noise.top_m * noise.top_m;
  P(5, 5) = 0.25 * (bottom + top);
  P(8, 8) = bottom + top;
  P(5, 8) = P(8, 5) = 0.5 * (top - bottom);
  return P;
}

/// Leaves of a bush beside it turn the rectangle, too: once more without what stands out of it.
Footprint footprint_of(const Places& places, const Sight& sight, const VehicleConfig& config) {
  const Footprint first = fit_footprint(places, config.footprint);
  if (config.footprint.method == FootprintMethod::hull) return first;
  const Places own = within(first, places, sight, config);
  return own.size() < places.size() ? fit_footprint(own, config.footprint) : first;
}

VehicleStatus judge(const Footprint& footprint, double top, const VehicleConfig& config) {
  const double longer = footprint.size().maxCoeff();
  const double shorter = footprint.size().minCoeff();
  if (longer > config.most_length_m || shorter > config.most_width_m) {
    return VehicleStatus::too_large;
  }
  const bool small = longer < config.least_length_m || top < config.least_height_m;
  return small ? VehicleStatus::too_small : VehicleStatus::fitted;
}

}  // namespace

VehicleFit fit_vehicle(const std::vector<BodyPoint>& points, const Sight& sight,
                       const VehicleConfig& config) {
  VehicleFit fit;
  if (static_cast<int>(points.size()) < config.least_points) return fit;
  fit.motion = motion_of(points, config);
  const Places places = thinned(points, fit.motion.velocity, config.thin_m);
  const Footprint footprint =
      as_seen(footprint_of(places, sight, config), sight, config.noise.setback);
  const double top = top_of(points, config.top_percentile);
  fit.status = judge(footprint, top, config);
  if (fit.status != VehicleStatus::fitted) return fit;
  const Rectangle best = likelier(footprint, points, top, sight, config);
  if (parted(best.footprint, sight, config)) {
    fit.status = VehicleStatus::parted;
    return fit;
  }
  fit.cuboid = cuboid_of(best, top);
  fit.covariance = covariance_of(best, config.noise);
  fit.front_log_odds = front_log_odds(points, fit.motion, best, config);
  return fit;
}

}  // namespace saker::detection
