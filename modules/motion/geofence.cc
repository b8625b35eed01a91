#include "saker/motion/geofence.h"

#include <algorithm>
#include <limits>
#include <string>

#include "saker/core/error.h"

namespace saker::motion {
namespace {

double distance_to_edge(const Eigen::Vector2d& p, const Eigen::Vector2d& a,
                        const Eigen::Vector2d& b) {
  const Eigen::Vector2d edge = b - a;
  const double length2 = edge.squaredNorm();
  const double t = length2 > 0 ? std::clamp((p - a).dot(edge) / length2, 0.0, 1.0) : 0.0;
  return (p - a - t * edge).norm();
}

/// Whether the ray from p along +x crosses the edge.
bool ray_crosses(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  if ((a.y() > p.y()) == (b.y() > p.y())) return false;
  return p.x() < a.x() + (p.y() - a.y()) * (b.x() - a.x()) / (b.y() - a.y());
}

}  // namespace

Geofence::Geofence(const GeofenceConfig& unchecked) {
  const GeofenceConfig config = core::checked(unchecked, "geofence");
  const std::size_t numbers = config.polygon_m.size();
  if (numbers % 2 != 0 || numbers < 6) {
    throw Error("geofence.polygon_m: " + std::to_string(numbers) +
                " numbers, expected x and y of at least three corners");
  }
  if (config.highest_m <= config.lowest_m) {
    throw Error("geofence.highest_m: " + std::to_string(config.highest_m) +
                ", expected more than lowest_m");
  }
  lowest_m_ = config.lowest_m;
  highest_m_ = config.highest_m;
  for (std::size_t i = 0; i < numbers; i += 2) {
    corners_.emplace_back(config.polygon_m[i], config.polygon_m[i + 1]);
  }
}

double Geofence::inside_m(const Eigen::Vector3d& p) const {
  return std::min(inside_band_m(p.z()), inside_polygon_m(p.head<2>()));
}

double Geofence::inside_band_m(double z) const { return std::min(z - lowest_m_, highest_m_ - z); }

double Geofence::inside_polygon_m(const Eigen::Vector2d& p) const {
  double nearest = std::numeric_limits<double>::infinity();
  bool inside = false;
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const Eigen::Vector2d& a = corners_[i];
    const Eigen::Vector2d& b = corners_[(i + 1) % corners_.size()];
    nearest = std::min(nearest, distance_to_edge(p, a, b));
    if (ray_crosses(p, a, b)) inside = !inside;
  }
  return inside ? nearest : -nearest;
}

}  // namespace saker::motion
