#include "saker/multirobot/alignment_evidence.h"

#include <Eigen/LU>
#include <algorithm>
#include <numbers>

#include "saker/slam/model_algebra.h"

namespace saker::multirobot {
namespace {

using std::numbers::pi;

constexpr double kRadian = pi / 180;
constexpr double kOtherClass =
    4;                      // unlikeness of a trunk and a pole: one in seven is taken for one
constexpr int kGrowth = 4;  // rounds of matching and fitting; three settle it

double square(double x) { return x * x; }

Star seen_from(const SE3& T_a_b, const Star& star) {
  Star seen = star;
  seen.place = T_a_b * star.place;
  seen.heading = star.heading + core::yaw(T_a_b.linear());
  return seen;
}

double planar_distance(const Star& a, const Star& b) {
  return (a.place - b.place).head<2>().norm();
}

bool seen_from_path(const Eigen::Vector3d& place, const std::vector<Eigen::Vector3d>& path,
                    double sight) {
  return std::ranges::any_of(path, [&](const Eigen::Vector3d& p) {
    return (p - place).head<2>().squaredNorm() <= sight * sight;
  });
}

std::vector<Eigen::Vector3d> path_of(const Survey& survey) {
  if (!survey.path.empty()) return survey.path;
  std::vector<Eigen::Vector3d> places;
  for (const auto& object : survey.map.objects) places.push_back(objects::place(object.model));
  return places;
}

/// Radius of the circle about the mean that holds all.
double extent(const std::vector<Star>& stars) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Star& star : stars) mean += star.place / static_cast<double>(stars.size());
  double radius = 1;
  for (const Star& star : stars) radius = std::max(radius, (star.place - mean).head<2>().norm());
  return radius;
}

}  // namespace

double half_turn(double angle) { return angle - pi * std::round(angle / pi); }

std::vector<Star> stars(const objects::ObjectMap& map, const ConstellationConfig& config) {
  std::vector<Star> all;
  for (const objects::MapObject& object : map.objects) {
    Star star;
    star.id = object.id;
    star.class_id = object.class_id;
    star.place = objects::place(object.model);
    if (const auto* cuboid = std::get_if<objects::Cuboid>(&object.model)) {
      star.cuboid = true;
      star.size = cuboid->size;
      star.heading = core::yaw(cuboid->pose.linear());
    } else {
      star.size.x() = std::get<objects::Cylinder>(object.model).radius;
    }
    star.sd = config.place_sd_m;
    if (object.covariance.rows() > 4) {
      const int x = star.cuboid ? 3 : 0;
      star.sd = std::max(star.sd, std::sqrt(object.covariance.block<2, 2>(x, x).trace() / 2));
    }
    if (star.place.allFinite() && star.size.allFinite() && std::isfinite(star.sd))
      all.push_back(star);
  }
  return all;
}

double unlikeness(const Star& a, const Star& b, double yaw, double height,
                  const ConstellationConfig& config) {
  double sum = square(height) / (square(a.sd) + square(b.sd));
  if (a.class_id != b.class_id) sum += kOtherClass;
  if (!a.cuboid) return sum + square(a.size.x() - b.size.x()) / (2 * square(config.radius_sd_m));
  const double turn = half_turn(a.heading - b.heading - yaw);
  return sum + (a.size - b.size).squaredNorm() / (2 * square(config.size_sd_m)) +
         square(turn) / (2 * square(config.heading_sd_deg * kRadian));
}

slam::PosePrior fit(const std::vector<Star>& a, const std::vector<Star>& b,
                    const std::vector<Match>& matches, const ConstellationConfig& config) {
  const auto star_a = [&](const Match& m) -> const Star& {
    return a[static_cast<std::size_t>(m.a)];
  };
  const auto star_b = [&](const Match& m) -> const Star& {
    return b[static_cast<std::size_t>(m.b)];
  };
  const auto weight = [&](const Match& m) {
    return 1 / (square(star_a(m).sd) + square(star_b(m).sd));
  };
  double sum = 0, cross = 0, dot = 0, spread = 0;
  Eigen::Vector3d mean_a = Eigen::Vector3d::Zero(), mean_b = mean_a;
  for (const Match& m : matches) {
    sum += weight(m);
    mean_a += weight(m) * star_a(m).place;
    mean_b += weight(m) * star_b(m).place;
  }
  mean_a /= sum, mean_b /= sum;
  for (const Match& m : matches) {
    const Eigen::Vector3d da = star_a(m).place - mean_a, db = star_b(m).place - mean_b;
    cross += weight(m) * (db.x() * da.y() - db.y() * da.x());
    dot += weight(m) * db.head<2>().dot(da.head<2>());
    spread += weight(m) * db.head<2>().squaredNorm();
  }
  slam::PosePrior result;
  result.pose.linear() = core::so3_exp({0, 0, std::atan2(cross, dot)});
  result.pose.translation() = mean_a - result.pose.linear() * mean_b;
  // known at the matches' middle: rotations there are independent of the translation
  Vector6d variance;
  variance << Eigen::Vector2d::Constant(square(config.level_sd_deg * kRadian)), 1 / spread,
      Eigen::Vector3d::Constant(1 / sum);
  SE3 T_middle_b = SE3::Identity();
  T_middle_b.translation() = -mean_b;
  const Matrix6d A = core::se3_adjoint(T_middle_b.inverse());
  result.covariance = A * variance.asDiagonal() * A.transpose();
  return result;
}

Comparison::Comparison(const Survey& a, const Survey& b, const ConstellationConfig& config)
    : config_(config),
      a_(stars(a.map, config)),
      b_(stars(b.map, config)),
      path_a_(path_of(a)),
      path_b_(path_of(b)) {}

Comparison::Hypothesis Comparison::grown(const std::vector<Match>& seed,
                                         const std::optional<AlignmentBounds>& bounds) const {
  Hypothesis hypothesis{fit(a_, b_, seed, config_), seed, 0, 0};
  double gain = 0;
  for (int round = 0; round < kGrowth; ++round) {
    std::vector<Match> all = matches(hypothesis.T_a_b.pose, &gain);
    if (all.size() < 2) break;
    hypothesis.T_a_b = fit(a_, b_, all, config_);
    hypothesis.matches = std::move(all);
  }
  const SE3& T_a_b = hypothesis.T_a_b.pose;
  hypothesis.log_likelihood_ratio = gain + missing(T_a_b, hypothesis.matches);
  // of x, y and yaw: the determinant is the same wherever it is taken
  Eigen::Matrix3d P;
  const Matrix6d& all = hypothesis.T_a_b.covariance;
  P << all(2, 2), all(2, 3), all(2, 4), all(3, 2), all(3, 3), all(3, 4), all(4, 2), all(4, 3),
      all(4, 4);
  const double log_peak = 1.5 * std::log(2 * pi) + 0.5 * std::log(P.determinant());
  hypothesis.log_odds =
      config_.independent * hypothesis.log_likelihood_ratio + log_peak - log_prior_volume(bounds);
  return hypothesis;
}

double Comparison::log_prior_volume(const std::optional<AlignmentBounds>& bounds) const {
  if (bounds) return std::log(pi * square(bounds->shift_m) * 2 * bounds->turn_deg * kRadian);
  return std::log(pi * square(extent(a_) + extent(b_)) * 2 * pi);
}

/// How many like it stand about there, in map a: per square metre, each weighed by likeness to it,
/// half of it by the likeness of all objects in both maps, lest a lone one seem unlike everything.
double Comparison::commonness(const Star& b, const Star& b_in_a) const {
  double near = 0, alike_near = 0, all = 0, alike = 0;
  for (const Star& other : a_) {
    if (other.cuboid != b.cuboid) continue;
    ++all;
    alike += std::exp(-unlikeness(other, b_in_a, 0, 0, config_) / 2);
    if (planar_distance(other, b_in_a) > config_.neighbourhood_m) continue;
    ++near;
    const double height = b_in_a.place.z() - other.place.z();
    alike_near += std::exp(-unlikeness(other, b_in_a, 0, height, config_) / 2);
  }
  for (const Star& other : b_) {
    if (other.cuboid != b.cuboid) continue;
    ++all;
    alike += std::exp(-unlikeness(other, b, 0, 0, config_) / 2);
  }
  near = std::max(near, 1.0);
  return near / (pi * square(config_.neighbourhood_m)) * 0.5 * (alike_near / near + alike / all);
}

/// Log-likelihood of two objects being one, over that of two that happen to stand there.
double Comparison::match_gain(const Star& a, const Star& b_in_a, double commonness) const {
  const double variance = square(a.sd) + square(b_in_a.sd);
  const double squared = square(planar_distance(a, b_in_a)) / variance;
  const double height = b_in_a.place.z() - a.place.z();
  return -std::log(2 * pi * variance) - (squared + unlikeness(a, b_in_a, 0, height, config_)) / 2 -
         std::log(commonness);
}

std::vector<Match> Comparison::matches(const SE3& T_a_b, double* gain) const {
  struct Gain {
    double gain;
    Match match;
  };
  const double of_two_misses = 2 * std::log(config_.missed);
  std::vector<Gain> gains;
  for (std::size_t j = 0; j < b_.size(); ++j) {
    const Star seen = seen_from(T_a_b, b_[j]);
    double common = -1;
    for (std::size_t i = 0; i < a_.size(); ++i) {
      if (a_[i].cuboid != seen.cuboid) continue;
      const double gate = config_.gate * std::hypot(a_[i].sd, seen.sd);
      if (planar_distance(a_[i], seen) > gate) continue;
      if (common < 0) common = commonness(b_[j], seen);
      const double value = match_gain(a_[i], seen, common);
      if (value > of_two_misses)
        gains.push_back({value, {static_cast<int>(i), static_cast<int>(j)}});
    }
  }
  std::ranges::stable_sort(gains, std::greater{}, &Gain::gain);
  std::vector<bool> taken_a(a_.size(), false), taken_b(b_.size(), false);
  std::vector<Match> chosen;
  *gain = 0;
  for (const auto& [value, match] : gains) {
    const auto i = static_cast<std::size_t>(match.a), j = static_cast<std::size_t>(match.b);
    if (taken_a[i] || taken_b[j]) continue;
    taken_a[i] = taken_b[j] = true;
    *gain += value;
    chosen.push_back(match);
  }
  return chosen;
}

double Comparison::missing(const SE3& T_a_b, const std::vector<Match>& matches) const {
  std::vector<bool> found_a(a_.size(), false), found_b(b_.size(), false);
  for (const Match& match : matches) {
    found_a[static_cast<std::size_t>(match.a)] = found_b[static_cast<std::size_t>(match.b)] = true;
  }
  int missing = 0;
  const SE3 T_b_a = T_a_b.inverse();
  for (std::size_t i = 0; i < a_.size(); ++i) {
    missing += !found_a[i] && seen_from_path(T_b_a * a_[i].place, path_b_, config_.sight_m) ? 1 : 0;
  }
  for (std::size_t j = 0; j < b_.size(); ++j) {
    missing += !found_b[j] && seen_from_path(T_a_b * b_[j].place, path_a_, config_.sight_m) ? 1 : 0;
  }
  return missing * std::log(config_.missed);
}

}  // namespace saker::multirobot
