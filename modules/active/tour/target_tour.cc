#include "saker/active/tour/target_tour.h"

#include <cstdio>
#include <utility>

namespace saker::active {
namespace {

using Phase = TargetState::Phase;

GoalLimits limits_of(const GoalsConfig& goals) {
  GoalLimits limits;
  limits.patience_s = goals.patience_s;
  limits.standing_s = goals.standing_s;
  limits.progress_m = goals.progress_m;
  limits.refused_m = goals.refused_m;
  limits.most_refusals = goals.most_refusals;
  limits.most_goals = goals.most_goals;
  limits.attempts = goals.attempts;
  return limits;
}

std::string no_progress(double closest_m) {
  char reason[100];
  std::snprintf(reason, sizeof(reason),
                "the vehicle came no nearer than %.1f m and saw nothing new", closest_m);
  return reason;
}

}  // namespace

TargetTour::TargetTour(const ActiveConfig& config, TargetList targets,
                       const ViewpointSampler& sampler, std::unique_ptr<const ViewChooser> chooser)
    : config_(config),
      limits_(limits_of(config.goals)),
      targets_(std::move(targets)),
      sampler_(sampler),
      chooser_(std::move(chooser)) {}

ActivePlan TargetTour::plan(const ActiveInput& input, const core::Budget& budget) {
  if (!accept(input)) return {};
  follow_list();
  if (map_) targets_.associate(*map_);
  observe();
  reopen();
  watch_progress();
  if (reorder_) order_tour(budget);
  while (!tour_.empty() && !fly_on(tour_.front())) {
    if (tour_.empty()) order_tour(budget);
  }
  return report();
}

bool TargetTour::accept(const ActiveInput& input) {
  const bool from_start = input.start && chooser_->decides_from_start();
  const Time stamp = from_start ? input.start->stamp : input.stamp;
  const SE3& T_world_body = from_start ? input.start->T_world_body : input.T_world_body;
  if (!input.T_world_odom.matrix().allFinite()) return false;
  if (!vehicle_.advance(stamp, T_world_body)) return false;
  map_ = input.map;
  grid_ = input.grid;
  block_ = {grid_.get(), input.T_world_odom.inverse()};
  reachability_ = Reachability(block_, vehicle_.position(), config_.viewpoints.clearance_m,
                               sampler_.in_geofence());
  for (ViewRecord& record : records_) record.history.map_holds(input.map_stamp.value_or(stamp));
  flown_.clear();
  return true;
}

ViewScene TargetTour::scene() const {
  std::optional<Eigen::Vector3d> end;
  if (config_.goals.return_home) end = Eigen::Vector3d(0, 0, config_.viewpoints.height_m);
  return {vehicle_, map_.get(), block_, reachability_, targets_.all(),
          states_,  records_,   tour_,  end,           expected_};
}

/// Targets that came get a state; those that were dismissed leave the tour.
void TargetTour::follow_list() {
  if (revision_ == targets_.revision()) return;
  revision_ = targets_.revision();
  const auto count = static_cast<std::size_t>(targets_.size());
  states_.resize(count, TargetState(limits_));
  records_.resize(count, chooser_->unseen());
  reorder_ = true;
  if (!current_ || !targets_[*current_].absent) return;
  states_[*current_].leave();
  current_.reset();
}

void TargetTour::observe() {
  for (int index = 0; index < targets_.size(); ++index) {
    if (targets_[index].status == TargetStatus::pending && sees(targets_[index])) observe(index);
  }
}

void TargetTour::observe(int index) {
  ViewRecord& record = records_[index];
  record.history.add(vehicle_.stamp(), vehicle_.position(), targets_[index].place(),
                     vehicle_.elapsed_s(), vehicle_.flown_m());
  const ViewOutcome outcome = chooser_->observe(scene(), index, record);
  if (outcome.is_new) states_[index].see_new();
  if (outcome.goal_seen) {
    expected_->seen_until = vehicle_.stamp();
    flown_.push_back(*expected_);
    expected_.reset();
  }
  if (outcome.target_done) close(index, seen_status(index), outcome.reason);
}

/// Views of a target that was closed as well known count, too: they may contradict the others.
void TargetTour::reopen() {
  for (int index = 0; index < targets_.size(); ++index) {
    const Target& target = targets_[index];
    ViewRecord& record = records_[index];
    if (!record.well_known || target.status == TargetStatus::pending) continue;
    if (sees(target)) {
      record.history.add(vehicle_.stamp(), vehicle_.position(), target.place(),
                         vehicle_.elapsed_s(), vehicle_.flown_m());
    }
    if (!chooser_->reopens(scene(), index)) continue;
    record.well_known = false;
    targets_.close(index, TargetStatus::pending, "");
    states_[index] = TargetState(limits_);
    reorder_ = true;
  }
}

bool TargetTour::sees(const Target& target) const {
  return sampler_.sees(vehicle_.position(), vehicle_.yaw(), target, block_, 0);
}

void TargetTour::watch_progress() {
  if (!current_) return;
  const int index = *current_;
  TargetState& state = states_[index];
  const Phase phase = state.update(vehicle_.position(), vehicle_.elapsed_s(), vehicle_.stands());
  if (phase == Phase::approaching) return;
  current_.reset();
  if (phase != Phase::waiting) end_attempt(index, no_progress(state.closest_m()));
}

/// The targets that are next: those with the fewest failed attempts.
std::vector<int> TargetTour::due() const {
  std::vector<int> due;
  for (int index = 0; index < targets_.size(); ++index) {
    if (targets_[index].status != TargetStatus::pending) continue;
    const int attempts = states_[index].attempts();
    if (!due.empty() && attempts > states_[due.front()].attempts()) continue;
    if (!due.empty() && attempts < states_[due.front()].attempts()) due.clear();
    due.push_back(index);
  }
  return due;
}

void TargetTour::order_tour(const core::Budget& budget) {
  const std::vector<int> indices = due();
  std::vector<Eigen::Vector3d> stops;
  for (const int index : indices) stops.push_back(targets_[index].place());
  std::optional<Eigen::Vector3d> home;
  if (config_.goals.return_home) home = Eigen::Vector3d::Zero();
  const TourProblem problem = straight_lines(stops, vehicle_.position(), home);
  const Tour tour = solve_tour(problem, config_.tour, budget);
  tour_.clear();
  for (const int place : tour.order) tour_.push_back(indices[place]);
  tour_length_m_ = tour.length;
  reorder_ = false;
}

/// To the next view of this target. \return false where there is none: its attempt has ended.
bool TargetTour::fly_on(int index) {
  if (!targets_[index].mapped()) expected_.reset();  // it is searched
  const ViewChoice choice = chooser_->choose(scene(), index);
  candidates_ = choice.candidates;
  records_[index].well_known = choice.well_known;
  if (choice.between_sides) records_[index].sides.also_between();
  if (choice.verdict == ViewChoice::Verdict::keep_goal) return true;
  if (choice.verdict == ViewChoice::Verdict::fly) {
    fly_to(index, choice);
    if (states_[index].phase() == Phase::approaching) return true;
  } else {
    states_[index].give_up();
  }
  end_attempt(index, chooser_->why_none(scene(), index, choice));
  return false;
}

void TargetTour::fly_to(int index, const ViewChoice& choice) {
  if (choice.expected) {
    expected_ = choice.expected;
    ++records_[index].goals;
  }
  const Phase phase = states_[index].fly_to(choice.viewpoint, vehicle_.position());
  if (phase != Phase::approaching) return;
  if (current_ && *current_ != index) states_[*current_].leave();
  current_ = index;
}

void TargetTour::refuse(int viewpoint_id, const std::string& reason) {
  if (!current_) return;
  const int index = *current_;
  if (states_[index].goal()->id != viewpoint_id) return;
  current_.reset();
  if (states_[index].refuse() != Phase::waiting) end_attempt(index, "no way there: " + reason);
}

/// What was seen from somewhere is visited; what was not is tried again later, or never.
void TargetTour::end_attempt(int index, const std::string& reason) {
  const std::string seen = chooser_->seen_from(scene(), index);
  if (!seen.empty()) {
    close(index, seen_status(index), seen + "; " + reason);
  } else if (states_[index].phase() == Phase::exhausted) {
    close(index, TargetStatus::unreachable, reason);
  } else {
    close(index, TargetStatus::pending, reason);
  }
}

/// Takes a target off the tour.
void TargetTour::close(int index, TargetStatus status, const std::string& reason) {
  targets_.close(index, status, reason);
  std::erase(tour_, index);
  states_[index].leave();
  if (current_ == index) current_.reset();
  reorder_ = true;
}

TargetStatus TargetTour::seen_status(int index) const {
  return targets_[index].mapped() ? TargetStatus::done : TargetStatus::visited;
}

ActivePlan TargetTour::report() const {
  ActivePlan plan;
  plan.status = current_ ? ActiveStatus::flying : ActiveStatus::finished;
  if (current_) plan.goal = states_[*current_].goal();
  if (plan.goal && expected_ && expected_->viewpoint_id == plan.goal->id) plan.expected = expected_;
  plan.flown = flown_;
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
