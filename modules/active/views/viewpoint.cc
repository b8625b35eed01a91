#include "saker/active/views/viewpoint.h"

#include <algorithm>
#include <numbers>

namespace saker::active {
namespace {

using objects::Cuboid;
using std::numbers::pi;

constexpr double kRingSearch = 0.25;  // m, between distances that are tried for the first ring
constexpr double kRaise = 0.25;       // m, between heights that are tried over a place
constexpr double kOverFloor = 0.5;    // m: safety holds the vehicle where it dips out of the fence

Viewpoint viewpoint_at(const Cuboid& target, double bearing, double distance, double height,
                       const FieldOfViewConfig& view) {
  Viewpoint viewpoint;
  viewpoint.bearing = bearing;
  const double elevation = std::atan2(0.5 * target.size.z() - height, distance);
  viewpoint.yaw = std::remainder(bearing + pi - viewing_azimuth(elevation, view), 2 * pi);
  viewpoint.position = target.pose.translation() + Eigen::Vector3d(distance * std::cos(bearing),
                                                                   distance * std::sin(bearing),
                                                                   height - 0.5 * target.size.z());
  return viewpoint;
}

/// The least distance at which all of the target is in view; the farthest one where it never is.
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

Refusal refusal_of(const Viewpoint& viewpoint, const Cuboid& target, const ViewpointConfig& config,
                   const FieldOfViewConfig& view, const OccupancyView& block,
                   const InGeofence& in_geofence) {
  const Eigen::Vector3d& eye = viewpoint.position;
  if (!in_field_of_view(eye, viewpoint.yaw, target, view, view.margin_deg))
    return Refusal::out_of_view;
  if (!in_geofence(eye)) return Refusal::outside_geofence;
  if (block.blocked(eye, config.clearance_m)) return Refusal::occupied;
  const double visible = visible_share(eye, target, block, config.own_margin_m);
  return visible < config.least_visible ? Refusal::hidden : Refusal::none;
}

std::vector<ViewpointCandidate> sample_viewpoints(const Cuboid& target, int first_id,
                                                  const ViewpointConfig& config,
                                                  const FieldOfViewConfig& view,
                                                  const OccupancyView& block,
                                                  const InGeofence& in_geofence) {
  std::vector<ViewpointCandidate> candidates;
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
      ViewpointCandidate& candidate = candidates.emplace_back();
      candidate.viewpoint =
          viewpoint_at(target, bearing, nearest + ring * config.ring_step_m, height, view);
      candidate.viewpoint.id = first_id + direction * config.rings + ring;
      candidate.known_free = block.at(candidate.viewpoint.position) == occupancy::Cell::free;
      candidate.refusal = refusal_of(candidate.viewpoint, target, config, view, block, in_geofence);
    }
  }
  return candidates;
}

}  // namespace saker::active
