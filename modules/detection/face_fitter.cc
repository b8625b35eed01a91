#include "saker/detection/face_fitter.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <tuple>
#include <utility>

#include "saker/detection/face_density.h"

namespace saker::detection {
namespace {

constexpr double kTypical[2] = {4.4, 1.8};  // m, length and width of a car

/// The points along a heading and across it.
struct Turned {
  double heading = 0;
  Places places;
  std::array<FaceStrips, 2> strips;
  std::array<Extent, 2> extent;                   ///< where most strips reach to
  std::array<std::array<double, 2>, 2> looked{};  ///< at [axis][low, high], 0 … 1
};

/// By the sensor that is farthest outside of a face's plane.
double looked_at(double outside_m, const FaceConfig& config) {
  return std::clamp(outside_m / config.outside_m, 0.0, 1.0);
}

Turned turned(const Places& places, const VehicleView& view, double heading,
              const FaceConfig& config) {
  Turned t;
  t.heading = heading;
  const Eigen::Matrix2d R = Eigen::Rotation2Dd(-heading).toRotationMatrix();
  t.places.reserve(places.size());
  for (const Eigen::Vector2d& p : places) t.places.push_back(R * p);
  std::vector<Eigen::Vector2d> sensors;
  for (const Eigen::Vector3d& s : view.sight.sensors) sensors.push_back(R * s.head<2>());
  for (int k = 0; k < 2; ++k) {
    t.strips[k] = strips_along(t.places, k, config);
    t.extent[k].low = t.strips[k].low_reach;
    t.extent[k].high = t.strips[k].high_reach;
    for (const Eigen::Vector2d& s : sensors) {
      t.looked[k][0] = std::max(t.looked[k][0], looked_at(t.extent[k].low - s[k], config));
      t.looked[k][1] = std::max(t.looked[k][1], looked_at(s[k] - t.extent[k].high, config));
    }
  }
  return t;
}

/// How flat the faces are that were looked at, log-likelihood of a heading.
double flatness(const Turned& t, const FaceConfig& config) {
  double sum = 0;
  for (int k = 0; k < 2; ++k) {
    if (t.looked[k][0] >= 0.5) sum += log_flat(t.strips[k].low, config);
    if (t.looked[k][1] >= 0.5) sum += log_flat(t.strips[k].high, config);
  }
  return sum;
}

/// Every so many, for speed.
Places some_of(const Places& places) {
  constexpr std::size_t kEnough = 600;
  const std::size_t stride = std::max<std::size_t>(places.size() / kEnough, 1);
  Places some;
  for (std::size_t i = 0; i < places.size(); i += stride) some.push_back(places[i]);
  return some;
}

struct Heading {
  double mean = 0, sd = 0;
};

/// Modulo a quarter turn: a coarse search, then the mean over a finer one.
Heading heading_of(const VehicleView& view, const FaceConfig& config) {
  constexpr double kCoarse = 3 * M_PI / 180, kFine = 0.75 * M_PI / 180;
  constexpr int kHeadings = 30, kFiner = 4;
  const Places places = some_of(view.places);
  const auto score = [&](double heading) {
    return flatness(turned(places, view, heading, config), config);
  };
  double best = 0, best_score = -INFINITY;
  for (int i = 0; i < kHeadings; ++i) {
    const double s = score(i * kCoarse);
    if (s > best_score) best = i * kCoarse, best_score = s;
  }
  double sum = 0, first = 0, second = 0;
  for (int i = -kFiner; i <= kFiner; ++i) {
    const double off = i * kFine;
    const double weight = std::exp(score(best + off) - best_score);
    sum += weight, first += weight * off, second += weight * off * off;
  }
  const double mean = first / sum;
  return {best + mean, std::hypot(std::sqrt(std::max(second / sum - mean * mean, 0.0)), kFine / 2)};
}

/// Where a face's middle line and corners are, by the faces beside it.
std::pair<double, double> middle_and_half(const Turned& t, int across) {
  const auto [low, high] = t.looked[across];
  const Extent& extent = t.extent[across];
  const bool both = std::min(low, high) > 0.5;
  const double width = both ? extent.size() : std::max(extent.size(), kTypical[across]);
  if (low >= 0.5 && low >= high) return {extent.low + width / 2, width / 2};
  if (high >= 0.5) return {extent.high - width / 2, width / 2};
  return {extent.centre(), width / 2};
}

/// One face of a vehicle, with a frame whose x axis points outward.
class Face {
 public:
  Face(const Turned& t, int axis, int end, const VehicleView& view, const FaceConfig& config)
      : t_(t),
        axis_(axis),
        end_(end),
        strips_(end == 0 ? t.strips[axis].low : t.strips[axis].high),
        view_(view),
        config_(config) {
    std::tie(middle_, half_) = middle_and_half(t, 1 - axis);
    hits_ = axis == 0 ? last_places() : outermost(strips_);
    alone_ = alone();
  }

  [[nodiscard]] FaceDensity density(double range) const {
    const FaceView face{strips_, hits_,    middle_, half_, axis_ == 0,
                        seen(),  corner(), alone_,  range};
    return face_density(face, free_from(), config_);
  }

 private:
  /// Of an end a few places along one side may be all that was seen: where the third last lies.
  [[nodiscard]] double last_places() const {
    std::array<double, 6> last;
    last.fill(-INFINITY);  // descending
    for (const Eigen::Vector2d& p : t_.places) {
      const double outward = end_ == 0 ? -p[axis_] : p[axis_];
      if (outward <= last.back()) continue;
      last.back() = outward;
      std::ranges::sort(last, std::greater<>());
    }
    return last.back();
  }

  /// Across the face, in the frame of a box whose x axis points outward.
  [[nodiscard]] double to_box(double across) const {
    const bool same_way = (axis_ == 0) == (end_ == 1);  // a quarter turn from outward is +across
    return same_way ? across : -across;
  }

  /// \param from, to  outward, m
  /// \param across    both edges, m
  [[nodiscard]] objects::Cuboid box(double from, double to, const Eigen::Vector2d& across,
                                    const std::array<double, 2>& height) const {
    const double outward = t_.heading + axis_ * M_PI / 2 + (end_ == 0 ? M_PI : 0);
    const auto [right, left] = std::minmax({to_box(across[0]), to_box(across[1])});
    return upright(outward, {Eigen::Vector2d(from, right), {to, left}}, height);
  }

  /// Outward place where beams come nearest, m.
  /// Of sides only before what was hit: how far they go on beside it is not known as widths are.
  [[nodiscard]] double free_from() const {
    constexpr double kShare = 0.85;  // what passes along a side tells nothing of an end
    constexpr double kInward = 0.5, kLeast = 0.2, kOutward = 3;  // m, from the hits
    const Extent& hit = t_.extent[1 - axis_];
    Eigen::Vector2d across(middle_ - kShare * half_, middle_ + kShare * half_);
    if (axis_ == 1) across = {std::max(hit.low, across[0]), std::min(hit.high, across[1])};
    if (!(across[0] < across[1])) return INFINITY;
    const objects::Cuboid beyond = box(hits_ - kInward, hits_ + kOutward, across,
                                       {config_.free_lowest_m, config_.free_highest_m});
    const Bow bow{0.5 * (axis_ == 0 ? config_.bow_end_m : config_.bow_side_m), half_,
                  to_box(middle_) - to_box(across.mean())};
    return hits_ - kInward + view_.sight.nearest(beyond, config_.free_beams, kInward - kLeast, bow);
  }

  /// Probability that the hits show the face: something may stand before it or about it.
  [[nodiscard]] double seen() const {
    return t_.looked[axis_][end_] * (1 - config_.hidden) * alone_;
  }

  /// The same of a face beside it, up to its corner with this one.
  [[nodiscard]] double corner() const {
    const auto [low, high] = t_.looked[1 - axis_];
    return std::max(low, high) * config_.corner * alone_;
  }

  /// Share of the points about an end that are the vehicle's; of sides 1.
  [[nodiscard]] double alone() const {
    if (axis_ != 0) return 1;
    constexpr double kInward = 0.4, kOutward = 0.15;  // m
    const std::array<double, 2> height = {0, 2};
    const Eigen::Vector2d across(middle_ - half_, middle_ + half_);
    const double others =
        view_.sight.others(box(hits_ - kInward, hits_ + kOutward, across, height));
    const double own = static_cast<double>(std::ranges::count_if(t_.places, [&](const auto& p) {
      return (end_ == 0 ? -p[axis_] : p[axis_]) > hits_ - kInward;
    }));
    const double points = own * view_.points / static_cast<double>(t_.places.size());
    return (points + 1) / (points + others + 1);
  }

  const Turned& t_;
  int axis_, end_;
  const std::vector<Strip>& strips_;
  const VehicleView& view_;
  const FaceConfig& config_;
  double middle_ = 0, half_ = 0, hits_ = 0, alone_ = 1;
};

/// The faces' posterior under one heading.
class Posterior {
 public:
  Posterior(const Turned& t, const VehicleView& view, double highest_m, const FaceConfig& config,
            const VehicleKinds& vehicle_kinds)
      : config_(config),
        vehicle_kinds_(vehicle_kinds),
        range_(nearest_range(Eigen::Rotation2Dd(t.heading) *
                                 Eigen::Vector2d(t.extent[0].centre(), t.extent[1].centre()),
                             view.sight)),
        size_{size_density(t, 0, view), size_density(t, 1, view)} {
    for (const VehicleKind& kind : vehicle_kinds_) {
      const Kind moments{size_[0].with(kind.plan[0]), size_[1].with(kind.plan[1])};
      probability_.push_back(std::log(kind.weight) +
                             log_likelihood_of_top(view.top, kind, highest_m, config.top_sd_m) +
                             moments[0].log_evidence + moments[1].log_evidence);
      kinds_.push_back(moments);
    }
    log_evidence_ = log_sum(probability_);
    for (double& p : probability_) p = std::exp(p - log_evidence_);
  }

  [[nodiscard]] double log_evidence() const { return log_evidence_; }

  /// Probability that it is more than one vehicle.
  [[nodiscard]] double several() const {
    double sum = 0;
    for (std::size_t k = 0; k < kinds_.size(); ++k) {
      if (!vehicle_kinds_[k].one_vehicle) sum += probability_[k];
    }
    return sum;
  }

  /// Along an axis, all kinds of one vehicle together.
  [[nodiscard]] Extent extent(int axis) const {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (std::size_t k = 0; k < kinds_.size(); ++k) {
      if (vehicle_kinds_[k].one_vehicle) sum += probability_[k] * kinds_[k][axis].mean;
    }
    const Eigen::Vector2d mean = sum / std::max(1 - several(), kNever);
    Eigen::Matrix2d covariance = about(mean, axis) + 1e-6 * Eigen::Matrix2d::Identity();
    covariance(0, 1) = covariance(1, 0) = -covariance(0, 1);  // outward is down at the low face
    return {-mean[0], mean[1], of_centre_and_size(covariance)};
  }

  static constexpr double kNever = 1e-9;        ///< a probability that changes nothing
  static constexpr double kPriorWindows = 100;  ///< of a vehicle that is looked at for long

 private:
  using Kind = std::array<SizeDensity::Moments, 2>;

  /// The second moment about a mean, with the prior of as many windows as say the same of it.
  [[nodiscard]] Eigen::Matrix2d about(const Eigen::Vector2d& mean, int axis) const {
    Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
    for (std::size_t k = 0; k < kinds_.size(); ++k) {
      if (!vehicle_kinds_[k].one_vehicle || probability_[k] < kNever) continue;
      const Normal prior = vehicle_kinds_[k].plan[axis];
      const auto weak = size_[axis].with({prior.mean, prior.sd * std::sqrt(kPriorWindows)});
      const Eigen::Vector2d off = mean - weak.mean;
      sum += probability_[k] *
             (weak.second - weak.mean * weak.mean.transpose() + off * off.transpose());
    }
    return sum / std::max(1 - several(), kNever);
  }

  [[nodiscard]] SizeDensity size_density(const Turned& t, int axis, const VehicleView& view) const {
    return {Face(t, axis, 0, view, config_).density(range_),
            Face(t, axis, 1, view, config_).density(range_)};
  }

  const FaceConfig& config_;
  const VehicleKinds& vehicle_kinds_;
  double range_;
  std::array<SizeDensity, 2> size_;
  std::vector<Kind> kinds_;
  std::vector<double> probability_;  ///< of each kind
  double log_evidence_ = 0;
};

/// Low and high edge along an axis, of the plan whose heading lies across.
Eigen::Vector2d edges_along(const Posterior& other, int axis, bool quarter_ahead) {
  const Extent along = other.extent(1 - axis);
  const bool opposite = quarter_ahead == (axis == 0);
  return opposite ? Eigen::Vector2d(-along.high, -along.low)
                  : Eigen::Vector2d(along.low, along.high);
}

/// The second moment of both headings about the likelier one.
std::array<Extent, 2> with_doubt(const Posterior& best, const Posterior& other,
                                 bool quarter_ahead) {
  std::array<Extent, 2> axis = {best.extent(0), best.extent(1)};
  const double odds = std::exp(other.log_evidence() - best.log_evidence());
  const double probability = odds / (1 + odds);
  if (probability < Posterior::kNever) return axis;
  for (int k = 0; k < 2; ++k) {
    const Eigen::Vector2d off =
        edges_along(other, k, quarter_ahead) - Eigen::Vector2d(axis[k].low, axis[k].high);
    axis[k].covariance += of_centre_and_size(probability * off * off.transpose());
  }
  return axis;
}

}  // namespace

Plan FaceFitter::outline(const VehicleView& view) const {
  const Heading heading = heading_of(view, config_);
  const Turned hits = turned(view.places, view, heading.mean, config_);
  const auto& [along, across] = hits.extent;
  if (along.size() >= across.size()) return {heading.mean, heading.sd, {along, across}};
  return {heading.mean + M_PI / 2, heading.sd, {across, {-along.high, -along.low}}};
}

Plan FaceFitter::fit(const VehicleView& view, const Plan& outline) const {
  const Turned along = turned(view.places, view, outline.heading, config_);
  const Turned across = turned(view.places, view, outline.heading - M_PI / 2, config_);
  const Posterior a(along, view, highest_m_, config_, kinds_),
      b(across, view, highest_m_, config_, kinds_);
  if (a.log_evidence() >= b.log_evidence()) {
    return {along.heading, outline.heading_sd, with_doubt(a, b, false), a.several() > 0.5};
  }
  return {across.heading, outline.heading_sd, with_doubt(b, a, true), b.several() > 0.5};
}

}  // namespace saker::detection
