#include "saker/active/discovery/sweep.h"

#include <cmath>

#include "saker/active/discovery/column.h"

namespace saker::active {
namespace {

constexpr int kFirstStopId = -2;  // and downwards: no id of a target's viewpoint

/// A stop is tried once.
GoalLimits limits_of(const SweepConfig& sweep) {
  GoalLimits limits;
  limits.patience_s = sweep.patience_s;
  limits.standing_s = sweep.standing_s;
  limits.progress_m = sweep.progress_m;
  limits.arrived_m = sweep.arrived_m;
  limits.dwell_s = sweep.seen_s;
  return limits;
}

}  // namespace

Sweep::Sweep(const ActiveConfig& config, const motion::Geofence& fence)
    : config_(config),
      limits_(limits_of(config.discovery.sweep)),
      fence_(fence),
      coverage_(config.discovery.sweep, config.view, fence) {}

void Sweep::observe(const VehicleTrack& vehicle, const OccupancyView& block,
                    const objects::ObjectMap* map) {
  coverage_.observe(vehicle.position(), vehicle.yaw(), vehicle.elapsed_s(), block, map);
}

std::optional<Viewpoint> Sweep::next(const VehicleTrack& vehicle, const OccupancyView& block,
                                     const objects::ObjectMap* map) {
  if (stop_) {
    stop_->state.update(vehicle.position(), vehicle.elapsed_s(), vehicle.stands());
    if (stop_->state.phase() != TargetState::Phase::approaching) close_stop();
  }
  for (auto next = coverage_.next(); next; next = coverage_.next()) {
    if (!stop_ || stop_->number != *next) {
      stop_ = Stop{*next, viewpoint_at(*next, vehicle, map), TargetState(limits_)};
      stop_->state.fly_to(stop_->viewpoint, vehicle.position());
    }
    if (flyable(stop_->viewpoint, block)) return stop_->viewpoint;
    close_stop();
  }
  stop_.reset();
  return std::nullopt;
}

bool Sweep::refuse(int viewpoint_id) {
  if (!stop_ || stop_->viewpoint.id != viewpoint_id) return false;
  close_stop();
  return true;
}

void Sweep::close_stop() {
  coverage_.close(stop_->number);
  stop_.reset();
}

Viewpoint Sweep::viewpoint_at(std::size_t number, const VehicleTrack& vehicle,
                              const objects::ObjectMap* map) const {
  const Eigen::Vector2d& place = coverage_.stops()[number];
  const Eigen::Vector2d way = place - vehicle.position().head<2>();
  const double height = ground_height(map, place) + config_.viewpoints.height_m;
  const InGeofence in_geofence = [&](const Eigen::Vector3d& p) { return fence_.contains(p); };
  Viewpoint viewpoint;
  viewpoint.id = kFirstStopId - static_cast<int>(number);
  viewpoint.position =
      raised_into(in_geofence, {place.x(), place.y(), height}, config_.view.farthest_m);
  viewpoint.yaw = std::atan2(way.y(), way.x());
  viewpoint.bearing = viewpoint.yaw;
  return viewpoint;
}

bool Sweep::flyable(const Viewpoint& viewpoint, const OccupancyView& block) const {
  return fence_.contains(viewpoint.position) &&
         !block.blocked(viewpoint.position, config_.viewpoints.clearance_m);
}

}  // namespace saker::active
