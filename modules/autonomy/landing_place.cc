#include "saker/autonomy/landing_place.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <numbers>

namespace saker::autonomy {
namespace {

using occupancy::Cell;
using occupancy::OccupancyGrid;

constexpr std::size_t kLowerPart = 5;    // one in: a quantile of the surfaces around a place
constexpr std::size_t kLeastAround = 8;  // surfaces, to say what surrounds it
constexpr double kSteps = 1.5;           // cells
constexpr std::size_t kLeastPlane = 3;

/// Height of the first occupied cell's top below `from_z`; NaN: there is none.
double surface(const OccupancyGrid& grid, const Eigen::Vector2d& p, double from_z) {
  if (grid.cells.empty()) return NAN;
  Eigen::Vector3i i = grid.index_of({p.x(), p.y(), from_z});
  if (i.x() < 0 || i.y() < 0 || i.x() >= grid.size.x() || i.y() >= grid.size.y()) return NAN;
  for (i.z() = std::min(i.z(), grid.size.z() - 1); i.z() >= 0; --i.z()) {
    if (grid.cells[grid.offset(i)] == Cell::occupied) {
      return grid.centre_of(i).z() + grid.resolution_m / 2;
    }
  }
  return NAN;
}

/// Calls `use` with the middle of each column of cells whose middle is within the ring.
template <class Use>
void for_columns(const OccupancyGrid& grid, const Eigen::Vector2d& centre, double from_m,
                 double to_m, Use use) {
  const int reach = static_cast<int>(std::ceil(to_m / grid.resolution_m)) + 1;
  const Eigen::Vector3i middle = grid.index_of({centre.x(), centre.y(), grid.origin.z()});
  for (int y = -reach; y <= reach; ++y) {
    for (int x = -reach; x <= reach; ++x) {
      const Eigen::Vector2d p = grid.centre_of(middle + Eigen::Vector3i(x, y, 0)).head<2>();
      const double away = (p - centre).norm();
      if (away >= from_m && away <= to_m) use(p);
    }
  }
}

/// a, b, c of z = a x + b y + c by least squares.
Eigen::Vector3d plane_of(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Identity() * 1e-6;  // of points in a line: level
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points) {
    const Eigen::Vector3d row(p.x(), p.y(), 1);
    normal += row * row.transpose();
    right += p.z() * row;
  }
  return normal.ldlt().solve(right);
}

}  // namespace

const char* to_string(LandingFault fault) {
  constexpr const char* kNames[] = {"none", "not seen, or nothing answers", "object", "slope",
                                    "raised"};
  return kNames[static_cast<int>(fault)];
}

double LandingPlace::badness() const {
  switch (fault) {
    case LandingFault::none:
      return 0;
    case LandingFault::slope:
      return 1 + slope_deg / 90;
    case LandingFault::not_seen:
      return 2 + 1 - seen_share;
    case LandingFault::raised:
      return 4 + raised_m / 100;
    case LandingFault::object:
      return 5 + off_plane_m / 100;
  }
  return INFINITY;
}

std::string LandingPlace::text() const {
  switch (fault) {
    case LandingFault::none:
      return "fit to land on";
    case LandingFault::slope:
      return fmt::format("not fit to land on: slope ({:.0f}°)", slope_deg);
    case LandingFault::not_seen:
      return fmt::format("not fit to land on: {:.0f} % of it seen", 100 * seen_share);
    case LandingFault::raised:
      return fmt::format("not fit to land on: raised ({:.1f} m)", raised_m);
    case LandingFault::object:
      return fmt::format("not fit to land on: object ({:.1f} m)", off_plane_m);
  }
  return {};
}

LandingLook::LandingLook(const LandingConfig& config)
    : config_(core::checked(config, "planning.landing")) {
  const int reach = static_cast<int>(config_.search_m / config_.search_step_m);
  for (int y = -reach; y <= reach; ++y) {
    for (int x = -reach; x <= reach; ++x) {
      const Eigen::Vector2d offset = config_.search_step_m * Eigen::Vector2d(x, y);
      if (offset.norm() <= config_.search_m) offsets_.push_back(offset);
    }
  }
  std::ranges::stable_sort(offsets_, {}, [](const Eigen::Vector2d& o) { return o.squaredNorm(); });
}

LandingPlace LandingLook::at(const OccupancyGrid& grid, const Eigen::Vector2d& place, double from_z,
                             const Eigen::Vector3d& stood) const {
  LandingPlace result;
  result.at = place;
  if (grid.cells.empty() || !place.allFinite() || !std::isfinite(from_z)) return result;
  std::vector<Eigen::Vector3d> surfaces;  // from the place's middle
  int columns = 0;
  for_columns(grid, place, 0, config_.radius_m, [&](const Eigen::Vector2d& p) {
    ++columns;
    double z = surface(grid, p, from_z);
    const bool stood_there = (p - stood.head<2>()).norm() <= config_.stood_radius_m;
    if (std::isnan(z) && stood_there) z = stood.z();
    if (!std::isnan(z)) surfaces.emplace_back(p.x() - place.x(), p.y() - place.y(), z);
  });
  result.seen_share = columns == 0 ? 0 : static_cast<double>(surfaces.size()) / columns;
  if (surfaces.size() < kLeastPlane || result.seen_share < config_.least_seen_share) return result;
  judge(surfaces, grid.resolution_m, result);
  if (!result.fit()) return result;
  const double lower_m = lower_around(grid, place, from_z);
  result.raised_m = surfaces.front().z() - lower_m;
  if (std::isnan(result.raised_m)) result.fault = LandingFault::not_seen;  // what surrounds it
  if (result.raised_m > config_.most_raised_m) result.fault = LandingFault::raised;
  return result;
}

/// Of the disc alone. Something beside the middle tilts the plane, too: what is steep and rises by
/// more than a slope twice as steep as allowed is an object.
void LandingLook::judge(const std::vector<Eigen::Vector3d>& surfaces, double cell_m,
                        LandingPlace& result) const {
  const Eigen::Vector3d plane = plane_of(surfaces);
  const double steepest = std::tan(config_.most_slope_deg * std::numbers::pi / 180);
  result.slope_deg = std::atan(plane.head<2>().norm()) * 180 / std::numbers::pi;
  double off = 0, lowest = INFINITY, highest = -INFINITY;
  for (const Eigen::Vector3d& p : surfaces) {
    off = std::max(off, std::abs(p.z() - plane.head<2>().dot(p.head<2>()) - plane.z()));
    lowest = std::min(lowest, p.z());
    highest = std::max(highest, p.z());
  }
  const bool stepped = highest - lowest > kSteps * cell_m;  // one step alone may be the cells'
  const bool steep = result.slope_deg > config_.most_slope_deg && stepped;
  const bool rises = highest - lowest > 4 * config_.radius_m * steepest + cell_m;
  result.off_plane_m = highest - lowest;
  result.fault = off > config_.most_off_plane_m || (steep && rises) ? LandingFault::object
                 : steep                                            ? LandingFault::slope
                                                                    : LandingFault::none;
}

/// m, of the lower part of the surfaces around a place; NaN: too few were seen.
double LandingLook::lower_around(const OccupancyGrid& grid, const Eigen::Vector2d& place,
                                 double from_z) const {
  std::vector<double> around;
  for_columns(grid, place, config_.radius_m, config_.around_m, [&](const Eigen::Vector2d& p) {
    const double z = surface(grid, p, from_z);
    if (!std::isnan(z)) around.push_back(z);
  });
  if (around.size() < kLeastAround) return NAN;
  const auto lower = around.begin() + static_cast<std::ptrdiff_t>(around.size() / kLowerPart);
  std::ranges::nth_element(around, lower);
  return *lower;
}

LandingPlace LandingLook::near(const OccupancyGrid& grid, const Eigen::Vector2d& place,
                               double from_z, const Eigen::Vector3d& stood,
                               const Allowed& allowed) const {
  LandingPlace best = at(grid, place, from_z, stood);
  for (const Eigen::Vector2d& offset : offsets_) {
    if (best.fit()) break;
    if (!allowed(place + offset)) continue;
    const LandingPlace other = at(grid, place + offset, from_z, stood);
    if (other.badness() < best.badness()) best = other;
  }
  return best;
}

ColumnLook look_up(const OccupancyGrid& grid, const Eigen::Vector3d& body, double radius_m,
                   double height_m) {
  ColumnLook look;
  if (grid.cells.empty() || !body.allFinite()) return look;
  for_columns(grid, body.head<2>(), 0, radius_m, [&](const Eigen::Vector2d& p) {
    for (double up = kOverBody_m; up <= height_m; up += grid.resolution_m) {
      const Cell cell = grid.at({p.x(), p.y(), body.z() + up});
      look.free += cell == Cell::free;
      look.unknown += cell == Cell::unknown;
      if (cell == Cell::occupied && !(look.lowest_m <= up)) look.lowest_m = up;
    }
  });
  return look;
}

}  // namespace saker::autonomy
