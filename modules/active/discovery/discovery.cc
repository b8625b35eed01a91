#include "saker/active/discovery.h"

#include <algorithm>
#include <cmath>

#include "saker/active/column.h"
#include "saker/core/se3.h"

namespace saker::active {
namespace {

using objects::MapObject;

constexpr double kLongestStep = 2.0;  // s that a decision stands for: two of its periods
constexpr double kStanding = 0.2;     // m/s and slower
constexpr int kFirstStopId = -2;      // and downwards: no id of a policy's viewpoint

bool swept(const SweepConfig& config, const Policy& policy) {
  return config.when == SweepWhen::always ||
         (config.when == SweepWhen::without_prior && without_prior(policy.targets()));
}

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
                     std::unique_ptr<TargetPolicy> policy, const motion::Geofence& fence)
    : config_(core::checked(config, "active")),
      table_(table),
      fence_(fence),
      policy_(std::move(policy)) {
  const SweepConfig& sweep = config_.discovery.sweep;
  if (swept(sweep, *policy_)) coverage_.emplace(sweep, config_.view, fence_);
}

ActivePlan Discovery::plan(const ActiveInput& input, const core::Budget& budget) {
  if (!accept(input)) return {};
  if (map_) find_newcomers();
  dismiss_absent();
  if (coverage_) coverage_->look(body_, yaw_, elapsed_s_, surroundings_, map_.get());
  ActivePlan plan = policy_->plan(input, budget);
  if (plan.status == ActiveStatus::finished) {
    sweep(plan);
  } else {
    stop_.reset();
  }
  if (coverage_) plan.seen_share = coverage_->seen_share();
  return plan;
}

bool Discovery::accept(const ActiveInput& input) {
  const bool finite =
      input.T_world_body.matrix().allFinite() && input.T_world_odom.matrix().allFinite();
  if (!finite || (last_stamp_ && input.stamp <= *last_stamp_)) return false;
  elapsed_s_ = last_stamp_ ? std::min(to_seconds(input.stamp - *last_stamp_), kLongestStep) : 0;
  last_stamp_ = input.stamp;
  const Eigen::Vector3d body = input.T_world_body.translation();
  stands_ = (body - body_).norm() < kStanding * elapsed_s_;
  body_ = body;
  yaw_ = core::yaw(input.T_world_body.linear());
  map_ = input.map;
  grid_ = input.grid;
  surroundings_ = {grid_.get(), input.T_world_odom.inverse()};
  return true;
}

void Discovery::find_newcomers() {
  std::map<int, Sighting> sightings;
  for (const MapObject& object : map_->objects) {
    if (stray(object)) watch(object, true, sightings);
  }
  for (const MapObject& object : map_->incomplete) {
    const bool wanted = without_prior(targets()) || fits_the_prior_better(object);
    if (wanted && stray(object)) watch(object, false, sightings);
  }
  sightings_ = std::move(sightings);
}

void Discovery::watch(const MapObject& object, bool complete, std::map<int, Sighting>& sightings) {
  const DiscoveryConfig& config = config_.discovery;
  const Eigen::Vector3d place = objects::place(object.model);
  const auto before = sightings_.find(object.id);
  const bool settled =
      before != sightings_.end() && (before->second.place - place).norm() <= config.moved_m;
  const Sighting sighting = settled ? before->second : Sighting{*last_stamp_, place};
  sightings.emplace(object.id, sighting);
  if (to_seconds(*last_stamp_ - sighting.since) < config.settle_s) return;
  if (discovered_ >= config.most || !in_reach(object)) return;
  policy_->target_list().add(object, complete);
  ++discovered_;
}

/// Whether it would be a target, and is none's: neither itself nor mapped twice.
bool Discovery::stray(const MapObject& object) const {
  if (object.class_id >= table_.size() || !table_[object.class_id].target) return false;
  const Eigen::Vector3d place = objects::place(object.model);
  if (!place.allFinite()) return false;
  return std::ranges::none_of(targets(), [&](const Target& target) {
    const double away = (target.place() - place).head<2>().norm();
    const bool holds_it = target.object_id == object.id || target.incomplete_id == object.id;
    return holds_it || (is_there(target) && away < config_.discovery.same_m);
  });
}

/// Whether it is nearest to the place of one of the prior map that took another one.
bool Discovery::fits_the_prior_better(const MapObject& object) const {
  return std::ranges::any_of(targets(), [&](const Target& prior) {
    if (prior.discovered || !prior.mapped() || prior.class_id != object.class_id) return false;
    const auto from_prior = [&](const Eigen::Vector3d& place) {
      return (place - prior.prior_place).head<2>().norm();
    };
    const double away = from_prior(objects::place(object.model));
    const auto is_nearer = [&](const Target& target) {
      return target.class_id == object.class_id && is_there(target) &&
             from_prior(target.place()) <= away;
    };
    return away <= config_.targets.gate_m && std::ranges::none_of(targets(), is_nearer);
  });
}

/// Judged by where one would look on it from.
bool Discovery::in_reach(const MapObject& object) const {
  Eigen::Vector3d above = objects::place(object.model);
  above.z() = bottom_of(object.model) + config_.viewpoints.height_m;
  return fence_.contains(in_fence(above));
}

/// Not below its floor.
Eigen::Vector3d Discovery::in_fence(const Eigen::Vector3d& place) const {
  const InGeofence in_geofence = [&](const Eigen::Vector3d& p) { return fence_.contains(p); };
  return raised_into(in_geofence, place, config_.view.farthest_m);
}

/// Also of those that were visited in vain: it says why.
void Discovery::dismiss_absent() {
  TargetList& list = policy_->target_list();
  absent_s_.resize(static_cast<std::size_t>(list.size()), 0);
  for (int i = 0; i < list.size(); ++i) {
    const Target& target = list[i];
    const bool vain = target.status == TargetStatus::visited && !target.absent;
    if (target.mapped() || !(vain || target.status == TargetStatus::pending)) continue;
    double& absent_s = absent_s_[static_cast<std::size_t>(i)];
    const bool absent = !may_be_incomplete(target) && nothing_else_at(target.expected_place());
    absent_s = absent ? absent_s + elapsed_s_ : 0;
    if (absent_s > config_.discovery.absent_s) list.dismiss(i, why_absent(target));
  }
}

bool Discovery::may_be_incomplete(const Target& target) const {
  return map_ && std::ranges::any_of(map_->incomplete, [&](const MapObject& object) {
           const Eigen::Vector3d between = objects::place(object.model) - target.expected_place();
           return object.class_id == target.class_id &&
                  between.head<2>().norm() <= config_.targets.gate_m;
         });
}

/// Nothing but what is mapped stands there, seen from so near that whatever is in the target's gate
/// is in range: it would be mapped.
bool Discovery::nothing_else_at(const Eigen::Vector3d& place) const {
  const DiscoveryConfig& config = config_.discovery;
  const double near = config_.view.farthest_m - config_.targets.gate_m;
  if (!grid_ || (place - body_).head<2>().norm() > near) return false;
  const int reach = static_cast<int>(config.around_m / config.around_step_m);
  int columns = 0, free = 0;
  for (int y = -reach; y <= reach; ++y) {
    for (int x = -reach; x <= reach; ++x) {
      const Eigen::Vector2d off = config.around_step_m * Eigen::Vector2d(x, y);
      if (off.norm() > config.around_m) continue;
      const Standing standing = standing_at(place.head<2>() + off, surroundings_, map_.get());
      ++columns;
      free += standing == Standing::nothing || standing == Standing::mapped;
    }
  }
  return free >= config.least_free * columns;
}

std::string Discovery::why_absent(const Target& target) const {
  const Target* same = nullptr;
  double nearest = config_.targets.gate_m;
  for (const Target& other : targets()) {
    if (!other.mapped() || other.class_id != target.class_id) continue;
    const double away = (other.place() - target.expected_place()).head<2>().norm();
    if (away > nearest) continue;
    nearest = away;
    same = &other;
  }
  if (same) return "the same as target " + std::to_string(same->id);
  return "no " + table_[target.class_id].name + " there: its place is free";
}

void Discovery::sweep(ActivePlan& plan) {
  if (!coverage_) return;
  if (stop_) watch_stop();
  for (auto next = coverage_->next(); next; next = coverage_->next()) {
    if (!stop_ || stop_->number != *next) {
      const Viewpoint viewpoint = viewpoint_at(*next);
      stop_ = Stop{*next, viewpoint, (viewpoint.position - body_).norm()};
    }
    if (flyable(stop_->viewpoint)) {
      plan.status = ActiveStatus::flying;
      plan.goal = stop_->viewpoint;
      return;
    }
    close_stop();
  }
  stop_.reset();
}

void Discovery::watch_stop() {
  const SweepConfig& config = config_.discovery.sweep;
  const double distance = (body_ - stop_->viewpoint.position).norm();
  stop_->idle_s += elapsed_s_;
  stop_->standing_s = stands_ ? stop_->standing_s + elapsed_s_ : 0;
  if (distance < config.arrived_m) stop_->there_s += elapsed_s_;
  if (distance < stop_->closest_m - config.progress_m) {
    stop_->closest_m = distance;
    stop_->idle_s = 0;
  }
  if (stop_->there_s > config.seen_s || stop_->idle_s > config.patience_s ||
      stop_->standing_s > config.standing_s) {
    close_stop();
  }
}

void Discovery::close_stop() {
  coverage_->close(stop_->number);
  stop_.reset();
}

Viewpoint Discovery::viewpoint_at(std::size_t number) const {
  const Eigen::Vector2d& place = coverage_->stops()[number];
  const Eigen::Vector2d way = place - body_.head<2>();
  Viewpoint viewpoint;
  viewpoint.id = kFirstStopId - static_cast<int>(number);
  const double height = ground_height(map_.get(), place) + config_.viewpoints.height_m;
  viewpoint.position = in_fence({place.x(), place.y(), height});
  viewpoint.yaw = std::atan2(way.y(), way.x());
  viewpoint.bearing = viewpoint.yaw;
  return viewpoint;
}

bool Discovery::flyable(const Viewpoint& viewpoint) const {
  return fence_.contains(viewpoint.position) &&
         !surroundings_.blocked(viewpoint.position, config_.viewpoints.clearance_m);
}

void Discovery::refuse(int viewpoint_id, const std::string& reason) {
  if (stop_ && stop_->viewpoint.id == viewpoint_id) {
    close_stop();
  } else {
    policy_->refuse(viewpoint_id, reason);
  }
}

}  // namespace saker::active
