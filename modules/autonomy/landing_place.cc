#include "saker/autonomy/landing_place.h"

#include <Eigen/Dense>
#include <algorithm>
#include <numbers>
#include <vector>

namespace saker::autonomy {
namespace {

using occupancy::Cell;

constexpr int kRounds = 6;  // of the fit: a car in a fifth of the circle is gone by then
constexpr std::size_t kLeastPoints = 8;  // of a plane

}  // namespace

core::Text LandingPlace::text() const {
  switch (ground) {
    case Ground::fit:
      return "the ground is fit";
    case Ground::occupied:
      return core::text("something {:.1f} m high stands there", value);
    case Ground::steep:
      return core::text("the ground is steep, {:.0f}°", value);
    case Ground::no_ground:
      return "no ground is seen there: water, or a hole";
    case Ground::unseen:
      return "the ground was not seen";
    case Ground::not_looked:
      break;
  }
  return "nobody has looked at the ground";
}

/// Level ground that lies on the border of two layers is in both.
double LandingPlaces::step_m() const { return std::max(config_.step_m, 1.5 * grid_.resolution_m); }

/// The tops of the columns of cells within a circle, and where they are from its middle.
template <class Visit>
void LandingPlaces::for_each(const Eigen::Vector3d& above, double radius_m, Visit visit) const {
  const double cell = grid_.resolution_m;
  const int reach = static_cast<int>(std::ceil(radius_m / cell));
  for (int y = -reach; y <= reach; ++y) {
    for (int x = -reach; x <= reach; ++x) {
      const Eigen::Vector2d from(cell * x, cell * y);
      if (from.norm() > radius_m) continue;
      visit(from, column(above + Eigen::Vector3d(from.x(), from.y(), 0)));
    }
  }
}

LandingPlaces::Column LandingPlaces::column(const Eigen::Vector3d& top) const {
  Column result;
  const Eigen::Vector2d from_takeoff = (top - takeoff_).head<2>();
  const bool stated = from_takeoff.norm() <= clearance_.takeoff_radius_m;
  result.stood = from_takeoff.norm() <= config_.stood_m;
  Eigen::Vector3i i = grid_.index_of(top);
  if (i.x() < 0 || i.y() < 0 || i.x() >= grid_.size.x() || i.y() >= grid_.size.y()) return result;
  for (i.z() = std::min(i.z(), grid_.size.z() - 1); i.z() >= 0; --i.z()) {
    const Cell seen = grid_.cells[grid_.offset(i)];
    const double z = grid_.centre_of(i).z();
    if (seen == Cell::occupied) {
      result.ground_m = z + grid_.resolution_m / 2;
      return result;
    }
    const bool ball = top.z() - z <= clearance_.vehicle_ball_m;
    if (seen == Cell::unknown && !stated && !ball && std::isnan(result.unseen_m))
      result.unseen_m = z;
  }
  return result;
}

LandingPlaces::Plane LandingPlaces::plane(const Eigen::Vector3d& above) const {
  std::vector<Eigen::Vector3d> points;
  for_each(above, config_.ground_m, [&](const Eigen::Vector2d& from, const Column& column) {
    if (!std::isnan(column.ground_m)) points.emplace_back(from.x(), from.y(), column.ground_m);
  });
  Plane plane;
  plane.offset = takeoff_.z();  // what it stood on is no higher
  for (int round = 0; round < kRounds && points.size() >= kLeastPoints; ++round) {
    Eigen::Matrix3d A = 1e-3 * Eigen::Matrix3d::Identity();  // level where it is open
    Eigen::Vector3d b = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& p : points) {
      const Eigen::Vector3d row(1, p.x(), p.y());
      A += row * row.transpose();
      b += p.z() * row;
    }
    const Eigen::Vector3d solved = A.ldlt().solve(b);
    plane = {solved.x(), solved.tail<2>()};
    const double most = step_m();
    std::erase_if(points,
                  [&](const Eigen::Vector3d& p) { return p.z() - plane.at(p.head<2>()) > most; });
  }
  return plane;
}

LandingPlaces::Tally LandingPlaces::tally(const Eigen::Vector3d& above, const Plane& plane) const {
  Tally tally;
  const double step = step_m();
  for_each(above, config_.clear_m, [&](const Eigen::Vector2d& from, const Column& column) {
    const double level = plane.at(from);
    const double over = column.ground_m - level;  // NaN: none
    if (over > step) tally.highest_m = std::max(tally.highest_m, over);
    ++tally.columns;
    if (column.unseen_m > level + step) ++tally.unseen;
    if (from.norm() > config_.legs_m) return;
    ++tally.legs;
    const bool carried = std::isnan(over) && column.stood;
    if (std::abs(over) <= step || carried) ++tally.ground;
  });
  return tally;
}

LandingPlace LandingPlaces::judge(const Eigen::Vector3d& above) const {
  LandingPlace place;
  if (!above.allFinite() || !(grid_.resolution_m > 0)) return place;
  place.above = above;
  const Plane ground = plane(above);
  const Tally seen = tally(above, ground);
  const double slope_deg = std::atan(ground.slope.norm()) * 180 / std::numbers::pi;
  if (seen.highest_m > 0) {
    place.ground = Ground::occupied;
    place.value = seen.highest_m;
  } else if (seen.unseen > config_.unseen_share * seen.columns) {
    place.ground = Ground::unseen;
  } else if (seen.ground < config_.seen_share * seen.legs) {
    place.ground = Ground::no_ground;
  } else if (slope_deg > config_.slope_deg) {
    place.ground = Ground::steep;
    place.value = slope_deg;
  } else {
    place.ground = Ground::fit;
  }
  return place;
}

std::optional<LandingPlace> LandingPlaces::nearest_fit(const Eigen::Vector3d& above) const {
  if (!above.allFinite() || !(grid_.resolution_m > 0)) return std::nullopt;
  const double step = 2 * grid_.resolution_m;
  const int reach = static_cast<int>(config_.reach_m / step);
  std::vector<Eigen::Vector2d> places;
  for (int y = -reach; y <= reach; ++y) {
    for (int x = -reach; x <= reach; ++x) places.emplace_back(step * x, step * y);
  }
  std::ranges::stable_sort(places, {}, [](const Eigen::Vector2d& p) { return p.squaredNorm(); });
  for (const Eigen::Vector2d& from : places) {
    if (from.norm() > config_.reach_m) break;
    const LandingPlace place = judge(above + Eigen::Vector3d(from.x(), from.y(), 0));
    if (place.fit()) return place;
  }
  return std::nullopt;
}

}  // namespace saker::autonomy
