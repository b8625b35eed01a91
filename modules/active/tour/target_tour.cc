#include "saker/active/touring.h"

#include <algorithm>
#include <cstdio>
#include <map>

#include "saker/core/se3.h"

namespace saker::active {
namespace {

constexpr double kLongestStep = 2.0;  // s that a decision stands for: two of its periods
constexpr double kStanding = 0.2;     // m/s and slower

}  // namespace

TouringPolicy::TouringPolicy(const ActiveConfig& config, TargetList targets, InGeofence in_geofence)
    : config_(config), targets_(std::move(targets)), in_geofence_(std::move(in_geofence)) {}

ActivePlan TouringPolicy::plan(const ActiveInput& input, const core::Budget& budget) {
  if (!accept(input)) return {};
  follow_list();
  if (map_) targets_.associate(*map_);
  observe();
  reconsider();
  watch_progress();
  if (reorder_) order_tour(budget);
  while (!tour_.empty() && !choose(tour_.front())) {
    give_up_target(tour_.front(), why_none(tour_.front()));
    if (tour_.empty()) order_tour(budget);
  }
  return report();
}

bool TouringPolicy::accept(const ActiveInput& input) {
  const bool finite =
      input.T_world_body.matrix().allFinite() && input.T_world_odom.matrix().allFinite();
  if (!finite || (last_stamp_ && input.stamp <= *last_stamp_)) return false;
  elapsed_s_ = last_stamp_ ? std::min(to_seconds(input.stamp - *last_stamp_), kLongestStep) : 0;
  const Eigen::Vector3d body = input.T_world_body.translation();
  stands_ = (body - body_).norm() < kStanding * elapsed_s_;
  if (last_stamp_) flown_m_ += (body - body_).norm();
  last_stamp_ = input.stamp;
  body_ = body;
  yaw_ = core::yaw(input.T_world_body.linear());
  map_ = input.map;
  grid_ = input.grid;
  surroundings_ = {grid_.get(), input.T_world_odom.inverse()};
  return true;
}

/// Targets that came get room; those that were dismissed leave the tour.
void TouringPolicy::follow_list() {
  if (revision_ == targets_.revision()) return;
  revision_ = targets_.revision();
  make_room(static_cast<std::size_t>(targets_.size()));
  reorder_ = true;
  if (goal_ && targets_[goal_->target].absent) goal_.reset();
}

void TouringPolicy::observe() {
  for (int index = 0; index < targets_.size(); ++index) {
    const Target& target = targets_[index];
    if (target.status == TargetStatus::pending && sees(body_, yaw_, target, 0)) look(index);
  }
}

bool TouringPolicy::sees(const Eigen::Vector3d& eye, double yaw, const Target& target,
                         double margin_deg) const {
  const ViewpointConfig& config = config_.viewpoints;
  return in_field_of_view(eye, yaw, target.extent, config_.view, margin_deg) &&
         visible_share(eye, target.extent, surroundings_, config.own_margin_m) >=
             config.least_visible;
}

void TouringPolicy::saw_something_new(int index) {
  records_[index].goals = 0;
  if (goal_ && goal_->target == index) goal_->idle_s = goal_->standing_s = 0;
}

void TouringPolicy::watch_progress() {
  if (!goal_) return;
  const GoalsConfig& config = config_.goals;
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
std::vector<int> TouringPolicy::due() const {
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

void TouringPolicy::order_tour(const core::Budget& budget) {
  const std::vector<int> indices = due();
  std::vector<Eigen::Vector3d> stops;
  for (const int index : indices) stops.push_back(targets_[index].place());
  std::optional<Eigen::Vector3d> home;
  if (config_.goals.return_home) home = Eigen::Vector3d::Zero();
  const Tour tour = solve_tour(straight_lines(stops, body_, home), config_.tour, budget);
  tour_.clear();
  for (const int place : tour.order) tour_.push_back(indices[place]);
  tour_length_m_ = tour.length;
  reorder_ = false;
}

/// Where the tour goes on after the current target; none where it may end anywhere.
std::optional<Eigen::Vector3d> TouringPolicy::next_place() const {
  if (tour_.size() > 1) return targets_[tour_[1]].place();
  if (!config_.goals.return_home) return std::nullopt;
  return Eigen::Vector3d(0, 0, config_.viewpoints.height_m);
}

bool TouringPolicy::fly_to(int index, const Viewpoint& viewpoint) {
  if (++records_[index].goals > config_.goals.most_goals) return false;
  goal_ = Goal{index, viewpoint, (body_ - viewpoint.position).norm()};
  return true;
}

std::vector<Candidate> TouringPolicy::viewpoints_of(int index) const {
  const ViewpointConfig& config = config_.viewpoints;
  std::vector<Candidate> candidates =
      sample_viewpoints(targets_[index].extent, index * config.bearings * config.rings, config,
                        config_.view, surroundings_, in_geofence_);
  for (Candidate& candidate : candidates) candidate.viewpoint.target_id = targets_[index].id;
  return candidates;
}

/// The goal stays where it is while it is good, with half of the margin: estimates tremble, and a
/// goal that does, too, is never reached.
Candidate TouringPolicy::goal_as_candidate() const {
  FieldOfViewConfig view = config_.view;
  view.margin_deg /= 2;
  Candidate current;
  current.viewpoint = goal_->viewpoint;
  current.known_free = surroundings_.at(goal_->viewpoint.position) == occupancy::Cell::free;
  current.refusal = refusal_of(current.viewpoint, targets_[goal_->target].extent,
                               config_.viewpoints, view, surroundings_, in_geofence_);
  return current;
}

bool TouringPolicy::was_given_up(int index, const Viewpoint& viewpoint) const {
  const std::vector<Eigen::Vector3d>& given_up = records_[index].given_up;
  return std::any_of(given_up.begin(), given_up.end(), [&](const Eigen::Vector3d& place) {
    return (place - viewpoint.position).norm() < config_.goals.refused_m;
  });
}

/// "no viewpoint left: 40 occupied, 12 hidden"
std::string TouringPolicy::why_none(int /*index*/) const {
  std::map<Refusal, int> count;
  for (const Candidate& candidate : candidates_) ++count[candidate.refusal];
  if (count.contains(Refusal::none)) return "too many viewpoints were flown to in vain";
  std::string text = "no viewpoint left:";
  for (const auto& [refusal, number] : count) {
    text += (text.back() == ':' ? " " : ", ") + std::to_string(number) + " " + to_string(refusal);
  }
  return text;
}

void TouringPolicy::refuse(int viewpoint_id, const std::string& reason) {
  if (goal_ && goal_->viewpoint.id == viewpoint_id) give_up_viewpoint("no way there: " + reason);
}

void TouringPolicy::give_up_viewpoint(const std::string& reason) {
  const int index = goal_->target;
  std::vector<Eigen::Vector3d>& given_up = records_[index].given_up;
  given_up.push_back(goal_->viewpoint.position);
  goal_.reset();
  if (static_cast<int>(given_up.size()) >= config_.goals.most_refusals) {
    give_up_target(index, reason);
  }
}

/// What was seen from somewhere is visited; what was not is tried again later, or never.
void TouringPolicy::give_up_target(int index, const std::string& reason) {
  Record& record = records_[index];
  const std::string seen = seen_from(index);
  ++record.attempts;
  record.given_up.clear();
  record.goals = 0;
  if (!seen.empty()) {
    close(index, seen_status(index), seen + "; " + reason);
  } else if (record.attempts >= config_.goals.attempts) {
    close(index, TargetStatus::unreachable, reason);
  } else {
    close(index, TargetStatus::pending, reason);
  }
}

/// Takes a target off the tour.
void TouringPolicy::close(int index, TargetStatus status, const std::string& reason) {
  targets_.close(index, status, reason);
  std::erase(tour_, index);
  if (goal_ && goal_->target == index) goal_.reset();
  reorder_ = true;
}

void TouringPolicy::reopen(int index) {
  targets_.close(index, TargetStatus::pending, "");
  records_[index] = {};
  reorder_ = true;
}

TargetStatus TouringPolicy::seen_status(int index) const {
  return targets_[index].mapped() ? TargetStatus::done : TargetStatus::visited;
}

ActivePlan TouringPolicy::report() const {
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
