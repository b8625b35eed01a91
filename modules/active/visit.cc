#include "active/visit.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <numbers>

#include "core/se3.h"

namespace saker::active {
namespace {

constexpr double kLongestStep = 2.0;  // s that a decision stands for: two of its periods
constexpr double kStanding = 0.2;     // m/s and slower
constexpr double kRadians = std::numbers::pi / 180;

/// "no viewpoint left: 40 occupied, 12 hidden"
std::string why_none(const std::vector<Candidate>& candidates) {
  std::map<Refusal, int> count;
  for (const Candidate& candidate : candidates) ++count[candidate.refusal];
  if (count.contains(Refusal::none)) return "too many viewpoints were flown to in vain";
  std::string text = "no viewpoint left:";
  for (const auto& [refusal, number] : count) {
    text += (text.back() == ':' ? " " : ", ") + std::to_string(number) + " " + to_string(refusal);
  }
  return text;
}

}  // namespace

VisitPolicy::VisitPolicy(const ActiveConfig& config, TargetList targets, InGeofence in_geofence)
    : config_(config), targets_(std::move(targets)), in_geofence_(std::move(in_geofence)) {
  follow_list();
}

/// Targets that came get a record; those that were dismissed leave the tour.
void VisitPolicy::follow_list() {
  if (revision_ == targets_.revision()) return;
  revision_ = targets_.revision();
  const VisitConfig& visit = config_.visit_policy;
  const Sides none(config_.viewpoints.bearings, visit.dwell_s, visit.separation_deg * kRadians);
  records_.resize(targets_.size(), Record{none, {}});
  reorder_ = true;
  if (goal_ && targets_[goal_->target].absent) goal_.reset();
}

ActivePlan VisitPolicy::plan(const ActiveInput& input, const core::Budget& budget) {
  if (!accept(input)) return {};
  follow_list();
  if (input.map) targets_.associate(*input.map);
  observe();
  watch_progress();
  if (reorder_) order_tour(budget);
  while (!tour_.empty() && !choose(tour_.front())) {
    give_up_target(tour_.front(), why_none(candidates_));
    if (tour_.empty()) order_tour(budget);
  }
  return report();
}

bool VisitPolicy::accept(const ActiveInput& input) {
  const bool finite =
      input.T_world_body.matrix().allFinite() && input.T_world_odom.matrix().allFinite();
  if (!finite || (last_stamp_ && input.stamp <= *last_stamp_)) return false;
  elapsed_s_ = last_stamp_ ? std::min(to_seconds(input.stamp - *last_stamp_), kLongestStep) : 0;
  last_stamp_ = input.stamp;
  const Eigen::Vector3d body = input.T_world_body.translation();
  stands_ = (body - body_).norm() < kStanding * elapsed_s_;
  body_ = body;
  grid_ = input.grid;
  surroundings_ = {grid_.get(), input.T_world_odom.inverse()};
  return true;
}

void VisitPolicy::observe() {
  for (int index = 0; index < targets_.size(); ++index) {
    const Target& target = targets_[index];
    if (target.status != TargetStatus::pending || !sees(target)) continue;
    const Eigen::Vector3d to_body = body_ - target.place();
    Record& record = records_[index];
    if (!record.sides.look(std::atan2(to_body.y(), to_body.x()), elapsed_s_)) continue;
    record.goals = 0;
    if (goal_ && goal_->target == index) goal_->idle_s = goal_->standing_s = 0;
    if (record.sides.count() >= config_.visit_policy.sides) close(index, seen_status(index), "");
  }
}

bool VisitPolicy::sees(const Target& target) const {
  const ViewpointConfig& config = config_.viewpoints;
  return in_field_of_view(body_, target.extent, config_.view, 0) &&
         visible_share(body_, target.extent, surroundings_, config.own_margin_m) >=
             config.least_visible;
}

void VisitPolicy::watch_progress() {
  if (!goal_) return;
  const VisitConfig& config = config_.visit_policy;
  const double distance = (body_ - goal_->viewpoint.position).norm();
  goal_->idle_s += elapsed_s_;
  goal_->standing_s = stands_ ? goal_->standing_s + elapsed_s_ : 0;
  if (distance < goal_->closest_m - config.progress_m) {
    goal_->closest_m = distance;
    goal_->idle_s = 0;
  }
  if (goal_->idle_s > config.patience_s || goal_->standing_s > config.standing_s) {
    char reason[100];
    std::snprintf(reason, sizeof(reason),
                  "the vehicle came no nearer than %.1f m and saw nothing new", goal_->closest_m);
    give_up_viewpoint(reason);
  }
}

/// The targets that are next: those with the fewest failed attempts.
std::vector<int> VisitPolicy::due() const {
  std::vector<int> due;
  for (int index = 0; index < targets_.size(); ++index) {
    if (targets_[index].status != TargetStatus::pending) continue;
    const int attempts = records_[index].attempts;
    if (!due.empty() && attempts > records_[due.front()].attempts) continue;
    if (!due.empty() && attempts < records_[due.front()].attempts) due.clear();
    due.push_back(index);
  }
  return due;
}

void VisitPolicy::order_tour(const core::Budget& budget) {
  const std::vector<int> indices = due();
  std::vector<Eigen::Vector3d> stops;
  for (const int index : indices) stops.push_back(targets_[index].place());
  std::optional<Eigen::Vector3d> home;
  if (config_.visit_policy.return_home) home = Eigen::Vector3d::Zero();
  const Tour tour = solve_tour(straight_lines(stops, body_, home), config_.tour, budget);
  tour_.clear();
  for (const int place : tour.order) tour_.push_back(indices[place]);
  tour_length_m_ = tour.length;
  reorder_ = false;
}

/// Whether there is a viewpoint of this target to fly to; it is the goal then.
bool VisitPolicy::choose(int index) {
  const ViewpointConfig& config = config_.viewpoints;
  candidates_ = sample_viewpoints(targets_[index].extent, index * config.bearings * config.rings,
                                  config, config_.view, surroundings_, in_geofence_);
  const Candidate* best = nullptr;
  for (Candidate& candidate : candidates_) {
    judge(candidate, index);
    if (candidate.refusal != Refusal::none) continue;
    if (!best || score(candidate) < score(*best)) best = &candidate;
  }
  if (keeps_goal(index, best)) return true;
  if (!best || ++records_[index].goals > config_.visit_policy.most_goals) return false;
  goal_ = Goal{index, best->viewpoint, (body_ - best->viewpoint.position).norm()};
  return true;
}

/// The goal stays where it is while it is good: with half of the margin, and hardly worse than the
/// best. Estimates tremble; a goal that does, too, is never reached.
bool VisitPolicy::keeps_goal(int index, const Candidate* best) const {
  if (!goal_ || goal_->target != index) return false;
  FieldOfViewConfig view = config_.view;
  view.margin_deg /= 2;
  Candidate current;
  current.viewpoint = goal_->viewpoint;
  current.known_free = surroundings_.at(goal_->viewpoint.position) == occupancy::Cell::free;
  current.refusal = refusal_of(current.viewpoint, targets_[index].extent, config_.viewpoints, view,
                               surroundings_, in_geofence_);
  judge(current, index);
  if (current.refusal != Refusal::none) return false;
  return !best || score(current) <= score(*best) + config_.visit_policy.switch_m;
}

/// Refusals that depend on what was done so far; gain: how obliquely the target is seen, 0 … 1.
void VisitPolicy::judge(Candidate& candidate, int index) const {
  const Target& target = targets_[index];
  const Record& record = records_[index];
  Viewpoint& viewpoint = candidate.viewpoint;
  viewpoint.target_id = target.id;
  candidate.cost_m = (body_ - viewpoint.position).norm();
  if (record.sides.count() + 1 >= config_.visit_policy.sides && tour_.size() > 1) {
    candidate.cost_m += (targets_[tour_[1]].place() - viewpoint.position).norm();
  }
  const double heading = core::yaw(target.extent.pose.linear());
  candidate.gain = target.mapped() ? std::abs(std::sin(2 * (viewpoint.bearing - heading))) : 0;
  if (candidate.refusal != Refusal::none) return;
  const bool given_up = std::any_of(
      record.given_up.begin(), record.given_up.end(), [&](const Eigen::Vector3d& place) {
        return (place - viewpoint.position).norm() < config_.visit_policy.refused_m;
      });
  if (given_up) candidate.refusal = Refusal::motion;
  if (!record.sides.apart(viewpoint.bearing)) candidate.refusal = Refusal::seen;
}

double VisitPolicy::score(const Candidate& candidate) const {
  const VisitConfig& config = config_.visit_policy;
  return candidate.cost_m - config.oblique_worth_m * candidate.gain -
         (candidate.known_free ? config.unknown_worth_m : 0);
}

void VisitPolicy::refuse(int viewpoint_id, const std::string& reason) {
  if (goal_ && goal_->viewpoint.id == viewpoint_id) give_up_viewpoint("no way there: " + reason);
}

void VisitPolicy::give_up_viewpoint(const std::string& reason) {
  const int index = goal_->target;
  std::vector<Eigen::Vector3d>& given_up = records_[index].given_up;
  given_up.push_back(goal_->viewpoint.position);
  goal_.reset();
  if (static_cast<int>(given_up.size()) >= config_.visit_policy.most_refusals) {
    give_up_target(index, reason);
  }
}

/// What was seen from some side is visited; what was not is tried again later, or never.
void VisitPolicy::give_up_target(int index, const std::string& reason) {
  Record& record = records_[index];
  const int sides = record.sides.count();
  ++record.attempts;
  record.given_up.clear();
  record.goals = 0;
  if (sides > 0) {
    close(index, seen_status(index),
          "seen from " + std::to_string(sides) + " of " +
              std::to_string(config_.visit_policy.sides) + " sides; " + reason);
  } else if (record.attempts >= config_.visit_policy.attempts) {
    close(index, TargetStatus::unreachable, reason);
  } else {
    close(index, TargetStatus::pending, reason);
  }
}

/// Takes a target off the tour.
void VisitPolicy::close(int index, TargetStatus status, const std::string& reason) {
  targets_.close(index, status, reason);
  std::erase(tour_, index);
  if (goal_ && goal_->target == index) goal_.reset();
  reorder_ = true;
}

TargetStatus VisitPolicy::seen_status(int index) const {
  return targets_[index].mapped() ? TargetStatus::done : TargetStatus::visited;
}

ActivePlan VisitPolicy::report() const {
  ActivePlan plan;
  plan.status = goal_ ? ActiveStatus::flying : ActiveStatus::finished;
  if (goal_) plan.goal = goal_->viewpoint;
  for (const int index : tour_) plan.tour.push_back(targets_[index].id);
  plan.tour_length_m = tour_length_m_;
  plan.candidates = candidates_;
  plan.pending = targets_.count(TargetStatus::pending);
  plan.done = targets_.count(TargetStatus::done);
  plan.visited = targets_.count(TargetStatus::visited);
  plan.unreachable = targets_.count(TargetStatus::unreachable);
  return plan;
}

}  // namespace saker::active
