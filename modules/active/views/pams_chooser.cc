#include "saker/active/pams.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "saker/active/flight_time.h"

namespace saker::active {
namespace {

ActiveConfig searching(ActiveConfig config, const PamsConfig& pams) {
  config.visit_policy.sides = pams.search.sides;
  config.visit_policy.between = pams.search.between;
  config.visit_policy.dwell_s = pams.search.dwell_s;
  return config;
}

}  // namespace

PamsPolicy::PamsPolicy(const ActiveConfig& config, const PamsConfig& pams, TargetList targets,
                       InGeofence in_geofence, ViewModel model, const motion::LimitsConfig& limits)
    : VisitPolicy(searching(config, pams), std::move(targets), std::move(in_geofence)),
      pams_(pams),
      model_(std::move(model)),
      limits_(limits) {}

void PamsPolicy::make_room(std::size_t targets) {
  VisitPolicy::make_room(targets);
  const ViewpointConfig& viewpoints = config_.viewpoints;
  looks_.resize(targets, LooksAndMap(Looks(viewpoints.bearings, viewpoints.ring_step_m)));
  cells_.resize(targets, 0);
  views_.resize(targets, 0);
  sure_.resize(targets, false);
}

ActivePlan PamsPolicy::plan(const ActiveInput& input, const core::Budget& budget) {
  flown_.clear();
  reachability_.reset();
  ActiveInput from_start = input;
  if (pams_.looked_from.from_start && input.start) {
    from_start.stamp = input.start->stamp;
    from_start.T_world_body = input.start->T_world_body;
  }
  const Time held = input.map_stamp.value_or(from_start.stamp);
  for (LooksAndMap& looks : looks_) looks.map_holds(held);
  ActivePlan plan = VisitPolicy::plan(from_start, budget);
  if (goal_ && flies_to(goal_->target)) plan.expected = expected_;
  plan.flown = flown_;
  return plan;
}

void PamsPolicy::look(int index) {
  looks_[index].add(*last_stamp_, body_, targets_[index].place(), elapsed_s_, flown_m_);
  if (!targets_[index].mapped()) return VisitPolicy::look(index);
  const Knowledge known = known_of(index);
  if (known.cells() > cells_[index]) {
    cells_[index] = known.cells();
    saw_something_new(index);
  }
  if (has_flown_to(index, known)) {
    expected_->seen_until = *last_stamp_;
    flown_.push_back(*expected_);
    expected_.reset();
  }
  sure_[index] = enough(index, known);
  if (sure_[index]) close(index, seen_status(index), why_none(index));
}

/// What was known well enough is looked at further where later windows contradict the earlier ones,
/// and looked for where they took it off the map.
void PamsPolicy::reconsider() {
  for (int index = 0; index < targets_.size(); ++index) {
    if (!sure_[index] || targets_[index].status == TargetStatus::pending) continue;
    if (sees(body_, yaw_, targets_[index], 0)) {
      looks_[index].add(*last_stamp_, body_, targets_[index].place(), elapsed_s_, flown_m_);
    }
    if (stays_closed(index)) continue;
    sure_[index] = false;
    reopen(index);
  }
}

/// Of a target that was known well enough.
bool PamsPolicy::stays_closed(int index) const {
  const Target& target = targets_[index];
  if (!target.mapped()) return target.absent || !pams_.map_counts;
  return size_is_known(index, known_of(index), pams_.reopen_share);
}

bool PamsPolicy::choose(int index) {
  if (!targets_[index].mapped()) {
    expected_.reset();
    return VisitPolicy::choose(index);
  }
  candidates_.clear();
  sure_[index] = enough(index, known_of(index));
  if (sure_[index] || views_[index] >= pams_.most_views) return false;
  if (!reachability_) {
    reachability_.emplace(surroundings_, body_, config_.viewpoints.clearance_m, in_geofence_);
  }
  candidates_ = viewpoints_of(index);
  for (Candidate& candidate : candidates_) judge(candidate, index);
  if (choose_among(index, region_of(index), pams_.sampling)) return true;
  if (!pams_.beyond_region || size_is_known(index, known_of(index), 1)) return false;
  const std::vector<bool> everywhere(candidates_.size(), true);
  return choose_among(index, everywhere, Sampling::uniform);
}

/// Whether each candidate lies in the region of good views, about the present estimate.
std::vector<bool> PamsPolicy::region_of(int index) const {
  const Target& target = targets_[index];
  std::vector<bool> region;
  for (const Candidate& candidate : candidates_) {
    const uncertainty::View view = view_from(candidate.viewpoint.position, target, model_);
    region.push_back(model_.in_region(target.class_id, view));
  }
  return region;
}

/// Refusals that depend on the flight so far.
void PamsPolicy::judge(Candidate& candidate, int index) const {
  const Eigen::Vector3d& place = candidate.viewpoint.position;
  candidate.cost_m = (body_ - place).norm();
  if (candidate.refusal != Refusal::none) return;
  const double since_m = flown_m_ + candidate.cost_m - looks_[index].so_far().first_m();
  if (was_given_up(index, candidate.viewpoint)) {
    candidate.refusal = Refusal::motion;
  } else if (!reachability_->reaches(place)) {
    candidate.refusal = Refusal::enclosed;
  } else if (pams_.drift_m * std::sqrt(std::max(since_m, 0.0)) > pams_.most_drift_m) {
    candidate.refusal = Refusal::drift;
  }
}

/// Whether the goal is a viewpoint of this target that was weighed, not one to look for it from.
bool PamsPolicy::flies_to(int index) const {
  return goal_ && goal_->target == index && expected_ &&
         expected_->viewpoint_id == goal_->viewpoint.id;
}

/// The target is looked at from the goal's cell, as cells lie about it now, and was for a dwell: an
/// estimate that turns takes all cells with it.
bool PamsPolicy::has_flown_to(int index, const Knowledge& known) const {
  if (!flies_to(index)) return false;
  const int cell = cell_from(body_, index);
  return cell == cell_from(goal_->viewpoint.position, index) && known.counted(cell);
}

/// The model's cell from which `eye` looks at the target.
int PamsPolicy::cell_from(const Eigen::Vector3d& eye, int index) const {
  return predicted(eye, targets_[index], model_, pams_).cell;
}

bool PamsPolicy::choose_among(int index, const std::vector<bool>& region, Sampling sampling) {
  const std::vector<int> samples =
      region_samples(candidates_, region, sampling, config_.viewpoints.rings);
  std::vector<bool> sampled(candidates_.size(), false);
  for (const int sample : samples) sampled[sample] = true;
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    Refusal& refusal = candidates_[i].refusal;
    if (refusal == Refusal::none || refusal == Refusal::region) {
      refusal = sampled[i] ? Refusal::none : Refusal::region;
    }
  }
  const Choice choice = choice_among(index, samples);
  const std::optional<Path> path = best_path(choice);
  if (!path) return false;
  const Viewpoint& next = choice.samples[path->stops.front()].viewpoint;
  if (flies_to(index) && next.id == goal_->viewpoint.id) return true;
  expect(choice, *path);
  ++views_[index];
  return fly_to(index, next);
}

PamsPolicy::Choice PamsPolicy::choice_among(int index, const std::vector<int>& samples) {
  Choice choice;
  choice.together = seen_together(index);
  for (const int target : choice.together) {
    choice.known.push_back(known_of(target));
    choice.problem.objects.push_back(belief_of(target, choice.known.back()));
    const double since_m = flown_m_ - looks_[target].so_far().first_m();
    choice.problem.drifted_m.push_back(std::isfinite(since_m) ? since_m : 0);
  }
  const auto weigh = [&](Candidate& candidate) {
    if (candidate.refusal != Refusal::none) return;
    std::vector<Sight> told = sights(candidate.viewpoint, choice);
    if (told.empty() || told.front().object != 0) {
      candidate.refusal = Refusal::seen;
      return;
    }
    choice.problem.stops.push_back(std::move(told));
    choice.samples.push_back(candidate);
  };
  for (const int sample : samples) {
    const bool is_goal = flies_to(index) && candidates_[sample].viewpoint.id == goal_->viewpoint.id;
    if (!is_goal) weigh(candidates_[sample]);
  }
  if (flies_to(index)) {
    Candidate goal = goal_as_candidate();
    judge(goal, index);
    weigh(goal);
  }
  add_ways(choice);
  return choice;
}

/// The target and the nearest others that a viewpoint of it may see.
std::vector<int> PamsPolicy::seen_together(int index) const {
  const Eigen::Vector3d place = targets_[index].place();
  const double reach = 2 * config_.view.farthest_m;
  std::vector<std::pair<double, int>> near;
  for (int other = 0; other < targets_.size(); ++other) {
    const Target& target = targets_[other];
    const double distance = (target.place() - place).norm();
    if (target.status != TargetStatus::pending || !target.mapped() || distance > reach) continue;
    near.emplace_back(other == index ? -1 : distance, other);
  }
  std::sort(near.begin(), near.end());
  std::vector<int> together;
  for (const auto& [distance, other] : near) {
    if (static_cast<int>(together.size()) < pams_.at_once) together.push_back(other);
  }
  return together;
}

/// What is seen from there and was not yet; of the current target, which is in view, first.
std::vector<Sight> PamsPolicy::sights(const Viewpoint& from, const Choice& choice) const {
  const Eigen::Vector3d& eye = from.position;
  std::vector<Sight> told;
  for (int object = 0; object < static_cast<int>(choice.together.size()); ++object) {
    const Target& target = targets_[choice.together[object]];
    if (object > 0 && !sees(eye, from.yaw, target, config_.view.margin_deg)) continue;
    const PredictedView view = predicted(eye, target, model_, pams_);
    const double near_s =
        looks_[choice.together[object]].so_far().seconds_near(eye, pams_.looked_from.near_m);
    if (choice.known[object].counted(view.cell) || near_s >= pams_.dwell_s) continue;
    told.push_back({object, view.cell, view.measured});
  }
  return told;
}

/// Ways and times between the vehicle, the samples and the next target.
void PamsPolicy::add_ways(Choice& choice) const {
  PathProblem& problem = choice.problem;
  const int count = static_cast<int>(choice.samples.size());
  const std::optional<Eigen::Vector3d> next = next_place();
  const auto seconds = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b, double turn) {
    return flight_time_s(b - a, turn, limits_);
  };
  problem.to_m = problem.to_s = problem.on_s = Eigen::VectorXd::Zero(count);
  problem.between_m = problem.between_s = Eigen::MatrixXd::Zero(count, count);
  for (int i = 0; i < count; ++i) {
    const Viewpoint& a = choice.samples[i].viewpoint;
    problem.to_m[i] = (a.position - body_).norm();
    problem.to_s[i] = seconds(body_, a.position, a.yaw - yaw_);
    if (next) problem.on_s[i] = seconds(a.position, *next, 0);
    for (int j = 0; j < count; ++j) {
      const Viewpoint& b = choice.samples[j].viewpoint;
      problem.between_m(i, j) = (b.position - a.position).norm();
      problem.between_s(i, j) = seconds(a.position, b.position, b.yaw - a.yaw);
    }
  }
  if (next) problem.direct_s = seconds(body_, *next, 0);
  problem.dwell_s = pams_.dwell_s;
  problem.drift_m = pams_.drift_counts ? pams_.drift_m : 0;
  problem.price_per_s = price_of(choice.together.front());
  problem.horizon = pams_.horizon;
  problem.most_paths = pams_.most_paths;
  problem.beam = pams_.beam;
}

/// What a second of flight to a target must bring, nat/s.
double PamsPolicy::price_of(int index) const {
  const bool beside = targets_[index].discovered && !without_prior(targets_.all());
  return beside ? pams_.discovered_price_per_s : pams_.price_per_s;
}

/// The path to fly; that through the goal while nothing is better by a margin. None when no path
/// brings enough.
std::optional<Path> PamsPolicy::best_path(const Choice& choice) const {
  if (choice.samples.empty()) return std::nullopt;
  const Path best = choose_path(choice.problem).best;
  const int last = static_cast<int>(choice.samples.size()) - 1;
  const int current = choice.together.front();
  if (flies_to(current) && choice.samples[last].viewpoint.id == goal_->viewpoint.id) {
    Path through_goal = choose_path(choice.problem, last).best;
    if (!pams_.replan || through_goal.value >= best.value - pams_.switch_gain) return through_goal;
  }
  if (best.stops.empty() || best.gain < pams_.least_gain) return std::nullopt;
  return best;
}

/// What is predicted of the path's first viewpoint, before it is flown to.
void PamsPolicy::expect(const Choice& choice, const Path& path) {
  const int stop = path.stops.front();
  const Viewpoint& viewpoint = choice.samples[stop].viewpoint;
  const int index = choice.together.front();
  const Target& target = targets_[index];
  const Eigen::MatrixXd common = model_.common(target.class_id);
  const Belief then =
      map_belief(target, looks_[index].in_map(), looks_until(viewpoint, index), model_, pams_);
  Eigen::Matrix4d covariance = then.covariance();
  if (!pams_.common_counts) covariance.topLeftCorner(common.rows(), common.cols()) += common;
  Expectation expected;
  expected.viewpoint_id = viewpoint.id;
  expected.target_id = target.id;
  expected.object_id = target.object_id;
  expected.gain = path_through(choice.problem, {stop}).gain;
  expected.covariance = covariance.topLeftCorner(common.rows(), common.cols());
  expected_ = expected;
}

/// With those of the straight way there, on which other sides come by.
Looks PamsPolicy::looks_until(const Viewpoint& viewpoint, int index) const {
  const Target& target = targets_[index];
  const Eigen::Vector3d way = viewpoint.position - body_;
  const double turn = std::remainder(viewpoint.yaw - yaw_, 2 * std::numbers::pi);
  const int steps = static_cast<int>(std::ceil(way.norm() / pams_.way_step_m));
  const double seconds = flight_time_s(way, turn, limits_) / std::max(steps, 1);
  Looks looks = looks_[index].so_far();
  for (int step = 0; step < steps; ++step) {
    const double share = (step + 0.5) / steps;
    const Eigen::Vector3d eye = body_ + share * way;
    if (!sees(eye, yaw_ + share * turn, target, 0)) continue;
    looks.add(eye, target.place(), seconds, flown_m_ + share * way.norm());
  }
  looks.add(viewpoint.position, target.place(), pams_.dwell_s, flown_m_ + way.norm());
  return looks;
}

/// What its views should tell, or what the map has where that is less.
Belief PamsPolicy::belief_of(int index, const Knowledge& known) const {
  if (!pams_.map_counts || targets_[index].covariance.size() == 0) return known.belief();
  const Belief in_map = belief_in_map(index);
  return in_map.entropy() > known.belief().entropy() ? in_map : known.belief();
}

/// What the map has of it, or is about to: it does not yet hold what was seen last.
Belief PamsPolicy::belief_in_map(int index) const {
  const LooksAndMap& looks = looks_[index];
  return map_belief(targets_[index], looks.in_map(), looks.so_far(), model_, pams_);
}

Knowledge PamsPolicy::known_of(int index) const {
  return Knowledge(targets_[index], looks_[index].so_far(), model_, pams_);
}

bool PamsPolicy::enough(int index, const Knowledge& known) const {
  return belief_of(index, known).entropy() <= pams_.enough_entropy &&
         size_is_known(index, known, 1) &&
         class_probability(targets_[index]) >= pams_.least_probability;
}

/// To a share of the greatest sd, by the map, or by its views where that says nothing; a cylinder's
/// place says all.
bool PamsPolicy::size_is_known(int index, const Knowledge& known, double share) const {
  const Target& target = targets_[index];
  if (model_.common(target.class_id).rows() < 4) return true;
  const Belief belief = target.covariance.size() == 0 ? known.belief() : belief_in_map(index);
  const Eigen::Vector2d variances = belief.covariance().diagonal().tail<2>();
  return std::sqrt(variances.maxCoeff()) <= share * pams_.most_size_sd_m;
}

/// Of the mapped object's class; 1 where the map does not say.
double PamsPolicy::class_probability(const Target& target) const {
  if (!map_) return 1;
  for (const objects::MapObject& object : map_->objects) {
    if (object.id != target.object_id) continue;
    const std::vector<double>& probability = object.class_probability;
    return target.class_id < probability.size() ? probability[target.class_id] : 1;
  }
  return 1;
}

std::string PamsPolicy::why_none(int index) const {
  if (!targets_[index].mapped()) return VisitPolicy::why_none(index);
  if (enough(index, known_of(index))) return "known well enough";
  if (views_[index] >= pams_.most_views) return "as many viewpoints were flown to as may be";
  const bool any = std::any_of(candidates_.begin(), candidates_.end(),
                               [](const Candidate& c) { return c.refusal == Refusal::none; });
  return any ? "no viewpoint in reach tells enough more" : VisitPolicy::why_none(index);
}

std::string PamsPolicy::seen_from(int index) const {
  if (cells_[index] > 0) return "seen from " + std::to_string(cells_[index]) + " cells";
  const bool in_passing = targets_[index].mapped() && !looks_[index].so_far().all().empty();
  return in_passing ? "seen in passing" : VisitPolicy::seen_from(index);
}

}  // namespace saker::active
