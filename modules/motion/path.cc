#include "saker/motion/path.h"

#include <algorithm>

#include "saker/motion/free_space.h"

namespace saker::motion {
namespace {

/// From each corner straight to the last one that can be seen from it.
Waypoints without_detours(const Waypoints& path, const FreeSpace& space) {
  Waypoints kept{path.front()};
  for (std::size_t at = 0; at + 1 < path.size();) {
    std::size_t next = path.size() - 1;
    while (next > at + 1 && !space.free(path[at], path[next])) --next;
    kept.push_back(path[next]);
    at = next;
  }
  return kept;
}

struct PathPoint {
  std::size_t leg;  // it lies between corners `leg` and `leg + 1`
  Eigen::Vector3d position;
};

PathPoint point_at(const Waypoints& path, double s) {
  for (std::size_t leg = 0; leg + 2 < path.size(); ++leg) {
    const double length = (path[leg + 1] - path[leg]).norm();
    if (s < length) return {leg, path[leg] + s / length * (path[leg + 1] - path[leg])};
    s -= length;
  }
  const Eigen::Vector3d last_leg = path.back() - path[path.size() - 2];
  const double share = std::min(1.0, s / std::max(last_leg.norm(), 1e-9));
  return {path.size() - 2, path[path.size() - 2] + share * last_leg};
}

Waypoints with_cut(const Waypoints& path, const PathPoint& from, const PathPoint& to) {
  Waypoints cut(path.begin(), path.begin() + static_cast<std::ptrdiff_t>(from.leg) + 1);
  cut.push_back(from.position);
  cut.push_back(to.position);
  cut.insert(cut.end(), path.begin() + static_cast<std::ptrdiff_t>(to.leg) + 1, path.end());
  return cut;
}

}  // namespace

double length_m(const Waypoints& path) {
  double length = 0;
  for (std::size_t i = 1; i < path.size(); ++i) length += (path[i] - path[i - 1]).norm();
  return length;
}

Waypoints shortened(const Waypoints& path, const FreeSpace& space, int tries, core::Rng rng) {
  if (path.size() < 3) return path;
  Waypoints best = without_detours(path, space);
  for (int i = 0; i < tries && best.size() > 2; ++i) {
    const double length = length_m(best);
    const double s = rng.uniform(0, length), t = rng.uniform(0, length);
    const PathPoint from = point_at(best, std::min(s, t));
    const PathPoint to = point_at(best, std::max(s, t));
    if (from.leg == to.leg || !space.free(from.position, to.position)) continue;
    best = with_cut(best, from, to);
  }
  return without_detours(best, space);
}

}  // namespace saker::motion
