#include "saker/detection/vehicle.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>

#include "saker/core/statistics.h"
#include "saker/detection/hull.h"

namespace saker::detection {
namespace {

constexpr int kSquareBits = 20;  // of a key, for each of column and row

/// A square's column or row, from the middle of its range: a cluster is no wider.
std::uint64_t square(double at, double edge) {
  constexpr std::int64_t kMiddle = std::int64_t{1} << (kSquareBits - 1);
  const auto index = static_cast<std::int64_t>(std::floor(at / edge)) + kMiddle;
  return static_cast<std::uint64_t>(std::clamp<std::int64_t>(index, 0, 2 * kMiddle - 1));
}

/// Squares seen so far, by open addressing.
class SquareSet {
 public:
  explicit SquareSet(std::size_t most) : slots_(std::bit_ceil(2 * most + 1), kFree) {}

  /// Whether it is new.
  bool insert(std::uint64_t square) {
    constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15;  // Fibonacci hashing (Knuth, vol. 3, 6.4)
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t at = (square * kGolden >> 32U) & mask;; at = (at + 1) & mask) {
      if (slots_[at] == square) return false;
      if (slots_[at] != kFree) continue;
      slots_[at] = square;
      return true;
    }
  }

 private:
  static constexpr std::uint64_t kFree = ~std::uint64_t{0};
  std::vector<std::uint64_t> slots_;
};

/// The first point of each small square: what lies dense counts once. In the order of squares.
Places thinned(const std::vector<BodyPoint>& points, const Eigen::Vector2d& velocity, double edge) {
  SquareSet seen(points.size());
  std::vector<std::pair<std::uint64_t, Eigen::Vector2d>> first;
  for (const BodyPoint& p : points) {
    const Eigen::Vector2d place =
        p.position.head<2>().cast<double>() - velocity * static_cast<double>(p.seconds);
    const std::uint64_t key = square(place.x(), edge) << kSquareBits | square(place.y(), edge);
    if (seen.insert(key)) first.emplace_back(key, place);
  }
  std::ranges::sort(first, {}, [](const auto& of) { return of.first; });
  Places thin;
  thin.reserve(first.size());
  for (const auto& [key, place] : first) thin.push_back(place);
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

/// Log-odds that the lower axis end … the end at +x is the front: the lower one (paper, IV-A).
double front_log_odds(const std::vector<BodyPoint>& points, const Motion& motion, const Plan& plan,
                      const VehicleConfig& config) {
  const Eigen::Vector2d x(std::cos(plan.heading), std::sin(plan.heading));
  std::vector<double> front;
  std::vector<double> rear;
  for (const BodyPoint& p : points) {
    const double at = x.dot(p.position.head<2>().cast<double>() -
                            motion.velocity * static_cast<double>(p.seconds));
    const double ratio = (at - plan.axis[0].low) / plan.axis[0].size();
    if (ratio < 0.25) rear.push_back(p.position.z());
    if (ratio > 0.75) front.push_back(p.position.z());
  }
  constexpr std::size_t kLeast = 8;
  if (front.size() < kLeast || rear.size() < kLeast) return 0;
  const double rise = core::percentile(rear, 0.9) - core::percentile(front, 0.9);
  const double most = config.most_front_log_odds;
  return std::clamp(rise / config.front_sd_m, -most, most);
}

objects::Cuboid cuboid_of(const Plan& plan, double top) {
  objects::Cuboid cuboid;
  const Eigen::Matrix3d R =
      Eigen::AngleAxisd(plan.heading, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  cuboid.pose.linear() = R;
  cuboid.pose.translation() =
      R * Eigen::Vector3d(plan.axis[0].centre(), plan.axis[1].centre(), 0.5 * top);
  cuboid.size = {plan.axis[0].size(), plan.axis[1].size(), top};
  return cuboid;
}

/// [rotation, translation, size] in the cuboid's own frame.
Matrix9d covariance_of(const Plan& plan, const VehicleNoiseConfig& noise) {
  Matrix9d P = Matrix9d::Zero();
  const double tilt = noise.tilt_deg * M_PI / 180;
  const double yaw = std::hypot(noise.yaw_deg * M_PI / 180, plan.heading_sd);
  P.diagonal().head<3>() << tilt * tilt, tilt * tilt, yaw * yaw;
  for (int k = 0; k < 2; ++k) {
    const Eigen::Matrix2d& along = plan.axis[k].covariance;
    P(3 + k, 3 + k) = along(0, 0);
    P(6 + k, 6 + k) = along(1, 1);
    P(3 + k, 6 + k) = P(6 + k, 3 + k) = along(0, 1);
  }
  const double bottom = noise.ground_m * noise.ground_m;
  const double top = noise.top_m * noise.top_m;
  P(5, 5) = 0.25 * (bottom + top);
  P(8, 8) = bottom + top;
  P(5, 8) = P(8, 5) = 0.5 * (top - bottom);
  return P;
}

/// \param outline of its points
VehicleStatus judge(const Plan& outline, double top, const Sight& sight,
                    const VehicleConfig& config) {
  const auto& [along, across] = outline.axis;
  const bool large = along.size() > config.most_length_m || across.size() > config.most_width_m;
  if (large) return VehicleStatus::too_large;
  const bool small = along.size() < config.least_length_m || top < config.least_height_m;
  if (small) return VehicleStatus::too_small;
  return parted(outline, sight, config.gap) ? VehicleStatus::parted : VehicleStatus::fitted;
}

bool of_some_kind(const Plan& plan, const VehicleKinds& kinds) {
  constexpr double kMostSd = 4;  // beyond, it is two beside each other: to be split
  const auto measured = [&](int k) {
    return Normal{plan.axis[k].size(), std::sqrt(plan.axis[k].covariance(1, 1))};
  };
  return is_of_some_kind({measured(0), measured(1)}, kMostSd, kinds);
}

}  // namespace

std::unique_ptr<const VehicleFitter> make_fitter(const VehicleConfig& config,
                                                 const VehicleKinds& kinds) {
  if (config.fitter == VehicleFitting::hull) return std::make_unique<HullFitter>(config.hull);
  return std::make_unique<FaceFitter>(config.faces, config.highest_m, kinds);
}

VehicleFit fit_vehicle(const std::vector<BodyPoint>& points, const Sight& sight,
                       const VehicleFitter& fitter, const VehicleConfig& config,
                       const VehicleKinds& kinds) {
  VehicleFit fit;
  if (static_cast<int>(points.size()) < config.least_points) return fit;
  fit.motion = motion_of(points, config);
  const VehicleView view{thinned(points, fit.motion.velocity, config.thin_m),
                         static_cast<int>(points.size()), top_of(points, config.top_percentile),
                         sight};
  if (view.places.size() < 3) return fit;
  const Plan outline = fitter.outline(view);
  fit.status = judge(outline, view.top, sight, config);
  if (fit.status != VehicleStatus::fitted) return fit;
  const Plan plan = fitter.fit(view, outline);
  if (plan.several) fit.status = VehicleStatus::parted;
  if (!of_some_kind(plan, kinds)) fit.status = VehicleStatus::too_large;
  if (fit.status != VehicleStatus::fitted) return fit;
  fit.cuboid = cuboid_of(plan, view.top);
  fit.covariance = covariance_of(plan, config.noise);
  fit.front_log_odds = front_log_odds(points, fit.motion, plan, config);
  return fit;
}

}  // namespace saker::detection
