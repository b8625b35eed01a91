#include "saker/active/visit.h"

#include <algorithm>
#include <numbers>

#include "saker/core/se3.h"

namespace saker::active {
namespace {

constexpr double kRadians = std::numbers::pi / 180;

}  // namespace

VisitPolicy::VisitPolicy(const ActiveConfig& config, TargetList targets, InGeofence in_geofence)
    : TouringPolicy(config, std::move(targets), std::move(in_geofence)) {}

void VisitPolicy::make_room(std::size_t targets) {
  TouringPolicy::make_room(targets);
  const VisitConfig& visit = config_.visit_policy;
  const Sides none(config_.viewpoints.bearings, visit.dwell_s, visit.separation_deg * kRadians);
  sides_.resize(targets, none);
}

void VisitPolicy::look(int index) {
  const Eigen::Vector3d to_body = body_ - targets_[index].place();
  if (!sides_[index].look(std::atan2(to_body.y(), to_body.x()), elapsed_s_)) return;
  saw_something_new(index);
  const bool all = sides_[index].count() >= config_.visit_policy.sides;
  if (all && !end_is_missing(index)) close(index, seen_status(index), "");
}

bool VisitPolicy::choose(int index) {
  if (choose_side(index)) return true;
  if (!end_is_missing(index) || sides_[index].count() == 0) return false;
  sides_[index].also_between();
  return choose_side(index);
}

/// It is worth more sides than others.
bool VisitPolicy::end_is_missing(int index) const {
  return config_.visit_policy.between && targets_[index].incomplete();
}

bool VisitPolicy::choose_side(int index) {
  candidates_ = viewpoints_of(index);
  const Candidate* best = nullptr;
  for (Candidate& candidate : candidates_) {
    judge(candidate, index);
    if (candidate.refusal != Refusal::none) continue;
    if (!best || score(candidate) < score(*best)) best = &candidate;
  }
  if (keeps_goal(index, best)) return true;
  return best && fly_to(index, best->viewpoint);
}

/// While it is good, and hardly worse than the best.
bool VisitPolicy::keeps_goal(int index, const Candidate* best) const {
  if (!goal_ || goal_->target != index) return false;
  Candidate current = goal_as_candidate();
  judge(current, index);
  if (current.refusal != Refusal::none) return false;
  return !best || score(current) <= score(*best) + config_.visit_policy.switch_m;
}

/// Refusals that depend on what was done so far; gain: how obliquely the target is seen, 0 … 1.
void VisitPolicy::judge(Candidate& candidate, int index) const {
  const Target& target = targets_[index];
  const Viewpoint& viewpoint = candidate.viewpoint;
  candidate.cost_m = (body_ - viewpoint.position).norm();
  if (sides_[index].count() + 1 >= config_.visit_policy.sides && tour_.size() > 1) {
    candidate.cost_m += (targets_[tour_[1]].place() - viewpoint.position).norm();
  }
  const double heading = core::yaw(target.extent.pose.linear());
  candidate.gain = target.mapped() ? std::abs(std::sin(2 * (viewpoint.bearing - heading))) : 0;
  if (candidate.refusal != Refusal::none) return;
  if (was_given_up(index, viewpoint)) candidate.refusal = Refusal::motion;
  if (!sides_[index].apart(viewpoint.bearing)) candidate.refusal = Refusal::seen;
}

double VisitPolicy::score(const Candidate& candidate) const {
  const VisitConfig& config = config_.visit_policy;
  return candidate.cost_m - config.oblique_worth_m * candidate.gain -
         (candidate.known_free ? config.unknown_worth_m : 0);
}

std::string VisitPolicy::seen_from(int index) const {
  const int sides = sides_[index].count();
  if (sides == 0) return "";
  const int wanted = std::max(config_.visit_policy.sides, sides);
  return "seen from " + std::to_string(sides) + " of " + std::to_string(wanted) + " sides";
}

}  // namespace saker::active
