#include "saker/active/discovery/coverage.h"

#include <algorithm>
#include <cmath>

#include "saker/active/discovery/column.h"
#include "saker/active/discovery/sweep_lines.h"
#include "saker/core/error.h"

namespace saker::active {
namespace {

using Eigen::Vector2d;

std::size_t nearest_of(const std::vector<Vector2d>& stops, const Vector2d& place) {
  const auto nearer = [&](const Vector2d& a, const Vector2d& b) {
    return (a - place).squaredNorm() < (b - place).squaredNorm();
  };
  return static_cast<std::size_t>(std::min_element(stops.begin(), stops.end(), nearer) -
                                  stops.begin());
}

}  // namespace

Coverage::Coverage(const SweepConfig& config, const FieldOfViewConfig& view,
                   const motion::Geofence& fence)
    : config_(config), view_(view) {
  const std::vector<Vector2d> all = middles(fence);
  stops_ = stops_on(sweep_lines(fence.corners(), config.spacing_m), config.step_m, config.inset_m);
  if (!stops_.empty() && stops_.front().norm() > stops_.back().norm()) {
    std::reverse(stops_.begin(), stops_.end());
  }
  assign(all);
}

/// Middles of the squares in the geofence.
std::vector<Vector2d> Coverage::middles(const motion::Geofence& fence) const {
  Eigen::AlignedBox2d box;
  for (const Vector2d& corner : fence.corners()) box.extend(corner);
  const Eigen::Array2d count = (box.sizes().array() / config_.cell_m).ceil().max(1);
  if (count.prod() > config_.most_cells) {
    throw Error("geofence.polygon_m: " + std::to_string(std::lround(box.volume())) +
                " m² are too many to sweep, expected at most " +
                std::to_string(std::lround(config_.most_cells * config_.cell_m * config_.cell_m)) +
                " (active.discovery.sweep.most_cells), or active.discovery.sweep.when: never");
  }
  std::vector<Vector2d> found;
  for (int y = 0; y < count.y(); ++y) {
    for (int x = 0; x < count.x(); ++x) {
      const Vector2d middle = box.min() + config_.cell_m * Vector2d(x + 0.5, y + 0.5);
      if (fence.inside_polygon_m(middle) >= 0) found.push_back(middle);
    }
  }
  return found;
}

void Coverage::assign(const std::vector<Vector2d>& middles) {
  for (const Vector2d& middle : middles) {
    const bool near = !stops_.empty() &&
                      (stops_[nearest_of(stops_, middle)] - middle).norm() <= config_.spacing_m;
    if (!near) stops_.push_back(middle);
  }
  squares_of_.assign(stops_.size(), 0);
  seen_of_.assign(stops_.size(), 0);
  closed_.assign(stops_.size(), false);
  for (const Vector2d& middle : middles) {
    squares_.push_back({middle, nearest_of(stops_, middle)});
    ++squares_of_[squares_.back().stop];
  }
}

bool Coverage::in_view(const Eigen::Vector3d& eye, double yaw, const Vector2d& middle,
                       const objects::ObjectMap* map) const {
  if ((middle - eye.head<2>()).norm() > view_.farthest_m) return false;
  if (sees_all_around(view_)) return true;
  return between_beams(eye, yaw, {middle.x(), middle.y(), ground_height(map, middle)}, view_);
}

void Coverage::observe(const Eigen::Vector3d& eye, double yaw, double seconds,
                       const OccupancyView& block, const objects::ObjectMap* map) {
  for (Square& square : squares_) {
    if (square.seen_s >= config_.seen_s) continue;
    if (!in_view(eye, yaw, square.middle, map)) continue;
    if (standing_at(square.middle, block, map) == Standing::unknown) continue;
    square.seen_s += seconds;
    if (square.seen_s >= config_.seen_s) ++seen_of_[square.stop];
  }
}

bool Coverage::due(std::size_t stop) const {
  return !closed_[stop] && seen_of_[stop] < config_.least_seen * squares_of_[stop];
}

std::optional<std::size_t> Coverage::next() {
  for (std::size_t i = 0; i < stops_.size(); ++i, current_ = (current_ + 1) % stops_.size()) {
    if (due(current_)) return current_;
  }
  return std::nullopt;
}

double Coverage::seen_share() const {
  double seen = 0;
  for (const int number : seen_of_) seen += number;
  return squares_.empty() ? 1 : seen / static_cast<double>(squares_.size());
}

}  // namespace saker::active
