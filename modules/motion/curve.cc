#include "saker/motion/curve.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace saker::motion {
namespace {

constexpr double kBetweenPoints_m = 0.05;
constexpr double kSameCorner_m = 1e-5;
constexpr double kStraight = 0.05;  // rad
constexpr double kTurnBack = 2.8;   // rad: an arc of so much has no radius left
constexpr int kHalvings = 5;        // of an arc that is not free

/// An arc between two legs; without a radius: the corner itself.
struct Arc {
  Eigen::Vector3d corner = Eigen::Vector3d::Constant(NAN);
  Eigen::Vector3d in = Eigen::Vector3d::Constant(NAN);   // unit
  Eigen::Vector3d out = Eigen::Vector3d::Constant(NAN);  // unit
  double angle = 0;                                      // rad, that it turns
  double cut_m = 0;                                      // of each leg
  bool stop = false;

  [[nodiscard]] double radius_m() const { return cut_m / std::tan(angle / 2); }
  [[nodiscard]] Eigen::Vector3d begin() const { return corner - cut_m * in; }
  [[nodiscard]] Eigen::Vector3d end() const { return corner + cut_m * out; }
  [[nodiscard]] Eigen::Vector3d inward() const {
    return (out - std::cos(angle) * in) / std::sin(angle);
  }
  [[nodiscard]] Eigen::Vector3d position(double turned) const {
    return begin() + radius_m() * (std::sin(turned) * in + (1 - std::cos(turned)) * inward());
  }
  [[nodiscard]] Eigen::Vector3d direction(double turned) const {
    return std::cos(turned) * in + std::sin(turned) * inward();
  }
  [[nodiscard]] int pieces(double longest_m) const {
    return std::max(2, static_cast<int>(std::ceil(radius_m() * angle / longest_m)));
  }
};

Waypoints distinct(const Waypoints& path) {
  Waypoints kept;
  for (const Eigen::Vector3d& p : path)
    if (kept.empty() || (p - kept.back()).norm() > kSameCorner_m) kept.push_back(p);
  return kept;
}

bool arc_free(const Arc& arc, const FreeSpace& space) {
  const int pieces = arc.pieces(0.5 * space.grid().resolution_m);
  for (int i = 0; i < pieces; ++i) {
    const Eigen::Vector3d a = arc.position(arc.angle * i / pieces);
    const Eigen::Vector3d b = arc.position(arc.angle * (i + 1) / pieces);
    if (!space.free(a, b)) return false;
  }
  return true;
}

Arc arc_at(const Waypoints& path, std::size_t i, const FreeSpace& space, double widest_m,
           double share) {
  const Eigen::Vector3d before = path[i] - path[i - 1], after = path[i + 1] - path[i];
  Arc arc;
  arc.corner = path[i];
  arc.in = before.normalized();
  arc.out = after.normalized();
  arc.angle = std::atan2(arc.in.cross(arc.out).norm(), arc.in.dot(arc.out));
  if (arc.angle < kStraight) return arc;
  arc.stop = true;
  if (arc.angle > kTurnBack) return arc;

  const double before_m = before.norm() * (i == 1 ? 1.0 : 0.5);
  const double after_m = after.norm() * (i + 2 == path.size() ? 1.0 : 0.5);
  arc.cut_m = share * std::min({widest_m, before_m, after_m});
  for (int halving = 0; halving < kHalvings; ++halving, arc.cut_m /= 2) {
    if (arc.cut_m <= kSameCorner_m || !arc_free(arc, space)) continue;
    arc.stop = false;
    return arc;
  }
  arc.cut_m = 0;
  return arc;
}

class CurveBuilder {
 public:
  explicit CurveBuilder(const Eigen::Vector3d& start, const Eigen::Vector3d& direction) {
    add({.position = start, .arriving = direction, .leaving = direction});
  }

  void leg_to(const Eigen::Vector3d& end, const Eigen::Vector3d& direction) {
    const Eigen::Vector3d from = curve_.back().position;
    const double length = (end - from).norm();
    if (length <= kSameCorner_m) return;
    const int pieces = std::max(2, static_cast<int>(std::ceil(length / kBetweenPoints_m)));
    for (int i = 1; i <= pieces; ++i) {
      add({.position = from + (end - from) * i / pieces,
           .arriving = direction,
           .leaving = direction});
    }
  }

  void turn(const Arc& arc) {
    if (arc.cut_m == 0) {
      curve_.back().leaving = arc.out;
      curve_.back().stop = arc.stop;
      return;
    }
    const double curvature = 1 / arc.radius_m();
    curve_.back().curvature = std::max(curve_.back().curvature, curvature);
    const int pieces = arc.pieces(kBetweenPoints_m);
    for (int i = 1; i <= pieces; ++i) {
      const double turned = arc.angle * i / pieces;
      const Eigen::Vector3d direction = arc.direction(turned);
      add({.position = arc.position(turned),
           .arriving = direction,
           .leaving = direction,
           .curvature = curvature});
    }
  }

  [[nodiscard]] Curve take() { return std::move(curve_); }

 private:
  void add(CurvePoint point) {
    point.s =
        curve_.empty() ? 0 : curve_.back().s + (point.position - curve_.back().position).norm();
    curve_.push_back(point);
  }

  Curve curve_;
};

}  // namespace

Curve rounded(const Waypoints& with_repeats, const FreeSpace& space, double widest_m,
              double first_share) {
  const Waypoints path = distinct(with_repeats);
  if (path.size() < 2) return CurveBuilder(path.front(), Eigen::Vector3d::UnitX()).take();

  CurveBuilder curve(path.front(), (path[1] - path[0]).normalized());
  for (std::size_t i = 1; i + 1 < path.size(); ++i) {
    const double share = i == 1 ? first_share : 1.0;
    const Arc arc = arc_at(path, i, space, widest_m, share);
    curve.leg_to(arc.begin(), arc.in);
    curve.turn(arc);
  }
  curve.leg_to(path.back(), (path.back() - path[path.size() - 2]).normalized());
  return curve.take();
}

}  // namespace saker::motion
