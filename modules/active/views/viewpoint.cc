#include "saker/active/viewpoint.h"

#include <algorithm>
#include <numbers>

namespace saker::active {
namespace {

using objects::Cuboid;
using std::numbers::pi;

constexpr double kRingSearch = 0.25;  // m, between distances that are tried for the first ring
constexpr double kRaise = 0.25;       // m, between heights that are tried over a place
constexpr double kOverFloor = 0.5;    // m: safety holds the vehicle where it dips out of the fence
constexpr double kRayHeight = 0.6;    // of the target: clear of the ground's cells
constexpr double kRayEdge = 0.9;      // of half the size: on the target, not beside it

bool within(const Eigen::Vector3d& in_target, const Cuboid& target, double margin) {
  return (in_target.cwiseAbs() - 0.5 * target.size).maxCoeff() <= margin;
}

/// The target's middle and its four vertical edges, in its own frame.
std::vector<Eigen::Vector3d> looked_at(const Cuboid& target) {
  const Eigen::Vector3d half = 0.5 * target.size;
  const double z = (2 * kRayHeight - 1) * half.z();
  std::vector<Eigen::Vector3d> points = {{0, 0, z}};
  for (const double x : {-kRayEdge, kRayEdge}) {
    for (const double y : {-kRayEdge, kRayEdge}) points.emplace_back(x * half.x(), y * half.y(), z);
  }
  return points;
}

/// Whether an occupied cell lies on the way from `eye` up to where the target begins.
bool hidden(const Eigen::Vector3d& eye, const Eigen::Vector3d& point_in_target,
            const Cuboid& target, const Surroundings& surroundings, double own_margin_m) {
  const Eigen::Vector3d eye_in_target = target.pose.inverse() * eye;
  const Eigen::Vector3d ray = point_in_target - eye_in_target;
  const int steps = static_cast<int>(2 * ray.norm() / surroundings.grid->resolution_m) + 1;
  for (int step = 0; step < steps; ++step) {
    const Eigen::Vector3d p = eye_in_target + ray * step / steps;
    if (within(p, target, own_margin_m)) return false;
    if (surroundings.at(target.pose * p) == occupancy::Cell::occupied) return true;
  }
  return false;
}

Viewpoint viewpoint_at(const Cuboid& target, double bearing, double distance, double height,
                       const FieldOfViewConfig& view) {
  Viewpoint viewpoint;
  viewpoint.bearing = bearing;
  const double elevation = std::atan2(0.5 * target.size.z() - height, distance);
  viewpoint.yaw = std::remainder(bearing + pi - looks_to(elevation, view), 2 * pi);
  viewpoint.position = target.pose.translation() + Eigen::Vector3d(distance * std::cos(bearing),
                                                                   distance * std::sin(bearing),
                                                                   height - 0.5 * target.size.z());
  return viewpoint;
}

/// The least distance at which the target is wholly in view; the farthest one where it never is.
double first_ring(const Cuboid& target, double bearing, double height,
                  const FieldOfViewConfig& view) {
  for (double distance = kRingSearch; distance < view.farthest_m; distance += kRingSearch) {
    const Viewpoint viewpoint = viewpoint_at(target, bearing, distance, height, view);
    if (in_field_of_view(viewpoint.position, viewpoint.yaw, target, view, view.margin_deg)) {
      return distance;
    }
  }
  return view.farthest_m;
}

}  // namespace

Eigen::Vector3d raised_into(const InGeofence& in_geofence, const Eigen::Vector3d& place,
                            double most_m) {
  if (in_geofence(place)) return place;
  for (double raise = kRaise; raise + kOverFloor <= most_m; raise += kRaise) {
    const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
    if (in_geofence(place + raise * up)) return place + (raise + kOverFloor) * up;
  }
  return place;
}

bool Surroundings::blocked(const Eigen::Vector3d& p_world, double radius) const {
  if (!grid) return false;
  const Eigen::Vector3d p = T_odom_world * p_world;
  const Eigen::Array3d reach = Eigen::Array3d::Constant(radius);
  const Eigen::Vector3i low = grid->index_of(p.array() - reach).cwiseMax(0);
  const Eigen::Vector3i high =
      grid->index_of(p.array() + reach).cwiseMin((grid->size.array() - 1).matrix());
  for (int z = low.z(); z <= high.z(); ++z) {
    for (int y = low.y(); y <= high.y(); ++y) {
      for (int x = low.x(); x <= high.x(); ++x) {
        const Eigen::Vector3i cell(x, y, z);
        if (grid->cells[grid->offset(cell)] == occupancy::Cell::occupied &&
            (grid->centre_of(cell) - p).norm() <= radius) {
          return true;
        }
      }
    }
  }
  return false;
}

double visible_share(const Eigen::Vector3d& eye, const Cuboid& target,
                     const Surroundings& surroundings, double own_margin_m) {
  if (!surroundings.grid) return 1;
  const std::vector<Eigen::Vector3d> points = looked_at(target);
  const auto visible = std::count_if(points.begin(), points.end(), [&](const auto& point) {
    return !hidden(eye, point, target, surroundings, own_margin_m);
  });
  return static_cast<double>(visible) / static_cast<double>(points.size());
}

Refusal refusal_of(const Viewpoint& viewpoint, const Cuboid& target, const ViewpointConfig& config,
                   const FieldOfViewConfig& view, const Surroundings& surroundings,
                   const InGeofence& in_geofence) {
  const Eigen::Vector3d& eye = viewpoint.position;
  if (!in_field_of_view(eye, viewpoint.yaw, target, view, view.margin_deg))
    return Refusal::out_of_view;
  if (!in_geofence(eye)) return Refusal::outside_geofence;
  if (surroundings.blocked(eye, config.clearance_m)) return Refusal::occupied;
  const double visible = visible_share(eye, target, surroundings, config.own_margin_m);
  return visible < config.least_visible ? Refusal::hidden : Refusal::none;
}

std::vector<Candidate> sample_viewpoints(const Cuboid& target, int first_id,
                                         const ViewpointConfig& config,
                                         const FieldOfViewConfig& view,
                                         const Surroundings& surroundings,
                                         const InGeofence& in_geofence) {
  std::vector<Candidate> candidates;
  for (int direction = 0; direction < config.bearings; ++direction) {
    const double bearing = std::remainder(2 * pi * direction / config.bearings, 2 * pi);
    double height = config.height_m;
    double nearest = first_ring(target, bearing, height, view);
    const Eigen::Vector3d low = viewpoint_at(target, bearing, nearest, height, view).position;
    if (const double raise = (raised_into(in_geofence, low, view.farthest_m) - low).z();
        raise > 0) {
      height += raise;
      nearest = first_ring(target, bearing, height, view);
    }
    for (int ring = 0; ring < config.rings; ++ring) {
      Candidate& candidate = candidates.emplace_back();
      candidate.viewpoint =
          viewpoint_at(target, bearing, nearest + ring * config.ring_step_m, height, view);
      candidate.viewpoint.id = first_id + direction * config.rings + ring;
      candidate.known_free = surroundings.at(candidate.viewpoint.position) == occupancy::Cell::free;
      candidate.refusal =
          refusal_of(candidate.viewpoint, target, config, view, surroundings, in_geofence);
    }
  }
  return candidates;
}

}  // namespace saker::active
