#include "saker/active/discovery/discovery.h"

#include <algorithm>
#include <cmath>

#include "saker/active/discovery/column.h"
#include "saker/active/views/viewpoint.h"

namespace saker::active {
namespace {

using objects::MapObject;

double bottom_of(const objects::Model& model) {
  const auto* cuboid = std::get_if<objects::Cuboid>(&model);
  const double half = cuboid ? 0.5 * cuboid->size.z() : 0;
  return objects::place(model).z() - half;
}

/// Whether there is something at its place, as far as one knows.
bool is_there(const Target& target) {
  return target.mapped() || target.incomplete() || (target.discovered && !target.absent);
}

}  // namespace

Discovery::Discovery(const ActiveConfig& config, const objects::ClassTable& table,
                     const motion::Geofence& fence)
    : config_(config), table_(table), fence_(fence) {}

void Discovery::update(const VehicleTrack& vehicle, const objects::ObjectMap* map,
                       const OccupancyView& block, TargetList& targets) {
  const Now now{vehicle, map, block};
  if (map) find_newcomers(now, targets);
  dismiss_absent(now, targets);
}

void Discovery::find_newcomers(const Now& now, TargetList& targets) {
  std::map<int, Sighting> sightings;
  for (const MapObject& object : now.map->objects) {
    if (stray(object, targets)) watch(object, true, now, targets, sightings);
  }
  for (const MapObject& object : now.map->incomplete) {
    const bool wanted = without_prior(targets.all()) || fits_the_prior_better(object, targets);
    if (wanted && stray(object, targets)) watch(object, false, now, targets, sightings);
  }
  sightings_ = std::move(sightings);
}

void Discovery::watch(const MapObject& object, bool complete, const Now& now, TargetList& targets,
                      std::map<int, Sighting>& sightings) {
  const DiscoveryConfig& config = config_.discovery;
  const Eigen::Vector3d place = objects::place(object.model);
  const auto before = sightings_.find(object.id);
  const bool settled =
      before != sightings_.end() && (before->second.place - place).norm() <= config.moved_m;
  const Sighting sighting = settled ? before->second : Sighting{now.vehicle.stamp(), place};
  sightings.emplace(object.id, sighting);
  if (to_seconds(now.vehicle.stamp() - sighting.since) < config.settle_s) return;
  if (discovered_ >= config.most || !in_reach(object)) return;
  targets.add(object, complete);
  ++discovered_;
}

/// Whether it would be a target, and is none's: neither itself nor mapped twice.
bool Discovery::stray(const MapObject& object, const TargetList& targets) const {
  if (object.class_id >= table_.size() || !table_[object.class_id].target) return false;
  const Eigen::Vector3d place = objects::place(object.model);
  if (!place.allFinite()) return false;
  return std::ranges::none_of(targets.all(), [&](const Target& target) {
    const double away = (target.place() - place).head<2>().norm();
    const bool holds_it = target.object_id == object.id || target.incomplete_id == object.id;
    return holds_it || (is_there(target) && away < config_.discovery.same_m);
  });
}

/// Whether it is nearest to the place of one of the prior map that took another one.
bool Discovery::fits_the_prior_better(const MapObject& object, const TargetList& targets) const {
  return std::ranges::any_of(targets.all(), [&](const Target& prior) {
    if (prior.discovered || !prior.mapped() || prior.class_id != object.class_id) return false;
    const auto from_prior = [&](const Eigen::Vector3d& place) {
      return (place - prior.prior_place).head<2>().norm();
    };
    const double away = from_prior(objects::place(object.model));
    const auto is_nearer = [&](const Target& target) {
      return target.class_id == object.class_id && is_there(target) &&
             from_prior(target.place()) <= away;
    };
    return away <= config_.targets.gate_m && std::ranges::none_of(targets.all(), is_nearer);
  });
}

/// Judged by where it would be seen from, which is not below the geofence's floor.
bool Discovery::in_reach(const MapObject& object) const {
  Eigen::Vector3d above = objects::place(object.model);
  above.z() = bottom_of(object.model) + config_.viewpoints.height_m;
  const InGeofence in_geofence = [&](const Eigen::Vector3d& p) { return fence_.contains(p); };
  return fence_.contains(raised_into(in_geofence, above, config_.view.farthest_m));
}

/// Also of those that were visited in vain: it says why.
void Discovery::dismiss_absent(const Now& now, TargetList& targets) {
  absent_s_.resize(static_cast<std::size_t>(targets.size()), 0);
  for (int i = 0; i < targets.size(); ++i) {
    const Target& target = targets[i];
    const bool vain = target.status == TargetStatus::visited && !target.absent;
    if (target.mapped() || !(vain || target.status == TargetStatus::pending)) continue;
    double& absent_s = absent_s_[static_cast<std::size_t>(i)];
    const bool absent =
        !may_be_incomplete(target, now) && nothing_else_at(target.expected_place(), now);
    absent_s = absent ? absent_s + now.vehicle.elapsed_s() : 0;
    if (absent_s > config_.discovery.absent_s) targets.dismiss(i, why_absent(target, targets));
  }
}

bool Discovery::may_be_incomplete(const Target& target, const Now& now) const {
  return now.map && std::ranges::any_of(now.map->incomplete, [&](const MapObject& object) {
           const Eigen::Vector3d between = objects::place(object.model) - target.expected_place();
           return object.class_id == target.class_id &&
                  between.head<2>().norm() <= config_.targets.gate_m;
         });
}

/// Nothing but what is mapped stands there, seen from so near that whatever is in the target's gate
/// is in range: it would be mapped.
bool Discovery::nothing_else_at(const Eigen::Vector3d& place, const Now& now) const {
  const DiscoveryConfig& config = config_.discovery;
  const double near = config_.view.farthest_m - config_.targets.gate_m;
  const double away = (place - now.vehicle.position()).head<2>().norm();
  if (!now.block.grid || away > near) return false;
  const int reach = static_cast<int>(config.around_m / config.around_step_m);
  int columns = 0, free = 0;
  for (int y = -reach; y <= reach; ++y) {
    for (int x = -reach; x <= reach; ++x) {
      const Eigen::Vector2d off = config.around_step_m * Eigen::Vector2d(x, y);
      if (off.norm() > config.around_m) continue;
      const Standing standing = standing_at(place.head<2>() + off, now.block, now.map);
      ++columns;
      free += standing == Standing::nothing || standing == Standing::mapped;
    }
  }
  return free >= config.least_free * columns;
}

std::string Discovery::why_absent(const Target& target, const TargetList& targets) const {
  const Target* same = nullptr;
  double nearest = config_.targets.gate_m;
  for (const Target& other : targets.all()) {
    if (!other.mapped() || other.class_id != target.class_id) continue;
    const double away = (other.place() - target.expected_place()).head<2>().norm();
    if (away > nearest) continue;
    nearest = away;
    same = &other;
  }
  if (same) return "the same as target " + std::to_string(same->id);
  return "no " + table_[target.class_id].name + " there: its place is free";
}

}  // namespace saker::active
