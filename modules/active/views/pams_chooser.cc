#include "saker/active/views/pams_chooser.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "saker/active/views/flight_time.h"
#include "saker/active/views/region_samples.h"

namespace saker::active {
namespace {

using Verdict = ViewChoice::Verdict;

VisitConfig searching(VisitConfig visit, const SearchConfig& search) {
  visit.sides = search.sides;
  visit.between = search.between;
  visit.dwell_s = search.dwell_s;
  return visit;
}

}  // namespace

PamsChooser::PamsChooser(const PamsConfig& pams, const VisitConfig& visit, ViewpointSampler sampler,
                         ViewModel model, const motion::LimitsConfig& limits)
    : config_(pams),
      search_(searching(visit, pams.search), sampler),
      sampler_(std::move(sampler)),
      model_(std::move(model)),
      limits_(limits) {}

TargetBelief PamsChooser::belief_of(const ViewScene& scene, int target) const {
  return {scene.targets[target], scene.records[target].history, model_, config_};
}

ViewOutcome PamsChooser::observe(const ViewScene& scene, int target, ViewRecord& record) const {
  const Target& seen = scene.targets[target];
  if (!seen.mapped()) return search_.observe(scene, target, record);
  const TargetBelief belief(seen, record.history, model_, config_);
  ViewOutcome outcome;
  outcome.is_new = belief.by_views().cells() > record.cells;
  record.cells = std::max(record.cells, belief.by_views().cells());
  outcome.goal_seen = goal_was_seen(scene, target, belief.by_views());
  record.well_known = belief.is_enough(scene.map);
  outcome.target_done = record.well_known;
  if (record.well_known) outcome.reason = "known well enough";
  return outcome;
}

/// A target that was known well enough is pending again where later windows contradict the earlier
/// ones, and is searched where they took it off the map.
bool PamsChooser::reopens(const ViewScene& scene, int target) const {
  const Target& closed = scene.targets[target];
  if (!closed.mapped()) return !closed.absent && config_.map_counts;
  return !belief_of(scene, target).size_is_known(config_.reopen_share);
}

ViewChoice PamsChooser::choose(const ViewScene& scene, int target) const {
  if (!scene.targets[target].mapped()) return search_.choose(scene, target);
  ViewChoice choice;
  const TargetBelief belief = belief_of(scene, target);
  choice.well_known = belief.is_enough(scene.map);
  if (choice.well_known || scene.records[target].goals >= config_.most_views) return choice;
  choice.candidates = sampler_.around(scene.targets[target], target, scene.block);
  for (ViewpointCandidate& candidate : choice.candidates) judge(scene, target, candidate);
  choose_among(scene, target, region_of(scene, target, choice), config_.sampling, choice);
  if (choice.verdict != Verdict::none) return choice;
  if (!config_.beyond_region || belief.size_is_known(1)) return choice;
  const std::vector<bool> everywhere(choice.candidates.size(), true);
  choose_among(scene, target, everywhere, Sampling::uniform, choice);
  return choice;
}

/// Whether each candidate lies in the region of good views, about the present estimate.
std::vector<bool> PamsChooser::region_of(const ViewScene& scene, int target,
                                         const ViewChoice& choice) const {
  const Target& seen = scene.targets[target];
  std::vector<bool> region;
  for (const ViewpointCandidate& candidate : choice.candidates) {
    const uncertainty::View view = view_from(candidate.viewpoint.position, seen, model_);
    region.push_back(model_.in_region(seen.class_id, view));
  }
  return region;
}

/// Adds the refusals that depend on the flight so far.
void PamsChooser::judge(const ViewScene& scene, int target, ViewpointCandidate& candidate) const {
  const Eigen::Vector3d& place = candidate.viewpoint.position;
  candidate.cost_m = (scene.vehicle.position() - place).norm();
  if (candidate.refusal != Refusal::none) return;
  const double first_m = scene.records[target].history.so_far().first_m();
  const double since_m = scene.vehicle.flown_m() + candidate.cost_m - first_m;
  if (scene.states[target].gave_up(place)) {
    candidate.refusal = Refusal::motion;
  } else if (!scene.reachability.reaches(place)) {
    candidate.refusal = Refusal::enclosed;
  } else if (config_.drift_m * std::sqrt(std::max(since_m, 0.0)) > config_.most_drift_m) {
    candidate.refusal = Refusal::drift;
  }
}

/// The goal, where it is a viewpoint of this target that was weighed, not one of the search.
const Viewpoint* PamsChooser::expected_goal(const ViewScene& scene, int target) const {
  const Viewpoint* goal = scene.goal(target);
  return goal && scene.expected && scene.expected->viewpoint_id == goal->id ? goal : nullptr;
}

/// The target is seen from the goal's cell, as cells lie about it now, and was for a dwell: an
/// estimate that turns takes all cells with it.
bool PamsChooser::goal_was_seen(const ViewScene& scene, int target, const Knowledge& known) const {
  const Viewpoint* goal = expected_goal(scene, target);
  if (!goal) return false;
  const int cell = cell_from(scene.vehicle.position(), scene.targets[target]);
  return cell == cell_from(goal->position, scene.targets[target]) && known.counted(cell);
}

/// The model's cell from which `eye` sees the target.
int PamsChooser::cell_from(const Eigen::Vector3d& eye, const Target& target) const {
  return predicted(eye, target, model_, config_).cell;
}

void PamsChooser::choose_among(const ViewScene& scene, int target, const std::vector<bool>& region,
                               Sampling sampling, ViewChoice& choice) const {
  const std::vector<int> samples =
      region_samples(choice.candidates, region, sampling, sampler_.config().rings);
  std::vector<bool> sampled(choice.candidates.size(), false);
  for (const int sample : samples) sampled[sample] = true;
  for (std::size_t i = 0; i < choice.candidates.size(); ++i) {
    Refusal& refusal = choice.candidates[i].refusal;
    if (refusal == Refusal::none || refusal == Refusal::region) {
      refusal = sampled[i] ? Refusal::none : Refusal::region;
    }
  }
  const Weighed weighed = weigh(scene, target, samples, choice);
  const std::optional<Path> path = best_path(scene, weighed);
  if (!path) return;
  choice.viewpoint = weighed.samples[path->stops.front()].viewpoint;
  const Viewpoint* goal = expected_goal(scene, target);
  if (goal && goal->id == choice.viewpoint.id) {
    choice.verdict = Verdict::keep_goal;
    return;
  }
  choice.verdict = Verdict::fly;
  choice.expected = expect(scene, weighed, *path);
}

PamsChooser::Weighed PamsChooser::weigh(const ViewScene& scene, int target,
                                        const std::vector<int>& samples, ViewChoice& choice) const {
  Weighed weighed;
  weighed.targets = seen_together(scene, target);
  for (const int seen : weighed.targets) {
    const TargetBelief belief = belief_of(scene, seen);
    weighed.known.push_back(belief.by_views());
    weighed.problem.objects.push_back(belief.belief());
    const double first_m = scene.records[seen].history.so_far().first_m();
    const double since_m = scene.vehicle.flown_m() - first_m;
    weighed.problem.drifted_m.push_back(std::isfinite(since_m) ? since_m : 0);
  }
  const Viewpoint* goal = expected_goal(scene, target);
  for (const int sample : samples) {
    ViewpointCandidate& candidate = choice.candidates[sample];
    if (!goal || candidate.viewpoint.id != goal->id) weigh(scene, candidate, weighed);
  }
  if (goal) {
    ViewpointCandidate current = sampler_.goal(*goal, scene.targets[target], scene.block);
    judge(scene, target, current);
    weigh(scene, current, weighed);
  }
  add_ways(scene, weighed);
  return weighed;
}

/// A candidate that nothing speaks against is a stop of the search, where it measures the target.
void PamsChooser::weigh(const ViewScene& scene, ViewpointCandidate& candidate,
                        Weighed& weighed) const {
  if (candidate.refusal != Refusal::none) return;
  std::vector<CellMeasurement> found = measurements(scene, candidate.viewpoint, weighed);
  if (found.empty() || found.front().object != 0) {
    candidate.refusal = Refusal::seen;
    return;
  }
  weighed.problem.stops.push_back(std::move(found));
  weighed.samples.push_back(candidate);
}

/// The target and the nearest others that a viewpoint of it may see.
std::vector<int> PamsChooser::seen_together(const ViewScene& scene, int target) const {
  const Eigen::Vector3d place = scene.targets[target].place();
  const double reach = 2 * sampler_.view().farthest_m;
  std::vector<std::pair<double, int>> near;
  for (int index = 0; index < static_cast<int>(scene.targets.size()); ++index) {
    const Target& other = scene.targets[index];
    const double distance = (other.place() - place).norm();
    if (other.status != TargetStatus::pending || !other.mapped() || distance > reach) continue;
    near.emplace_back(index == target ? -1 : distance, index);
  }
  std::sort(near.begin(), near.end());
  std::vector<int> together;
  for (const auto& [distance, index] : near) {
    if (static_cast<int>(together.size()) < config_.at_once) together.push_back(index);
  }
  return together;
}

/// Of cells that do not count yet; that of the current target, which is in view, first.
std::vector<CellMeasurement> PamsChooser::measurements(const ViewScene& scene,
                                                       const Viewpoint& from,
                                                       const Weighed& weighed) const {
  const Eigen::Vector3d& eye = from.position;
  const double margin_deg = sampler_.view().margin_deg;
  std::vector<CellMeasurement> found;
  for (int object = 0; object < static_cast<int>(weighed.targets.size()); ++object) {
    const int index = weighed.targets[object];
    const Target& seen = scene.targets[index];
    if (object > 0 && !sampler_.sees(eye, from.yaw, seen, scene.block, margin_deg)) continue;
    const PredictedView view = predicted(eye, seen, model_, config_);
    const double near_s =
        scene.records[index].history.so_far().seconds_near(eye, config_.looked_from.near_m);
    if (weighed.known[object].counted(view.cell) || near_s >= config_.dwell_s) continue;
    found.push_back({object, view.cell, view.measured});
  }
  return found;
}

/// Ways and times between the vehicle, the samples and the next target.
void PamsChooser::add_ways(const ViewScene& scene, Weighed& weighed) const {
  PathProblem& problem = weighed.problem;
  const int count = static_cast<int>(weighed.samples.size());
  const Eigen::Vector3d& vehicle = scene.vehicle.position();
  const std::optional<Eigen::Vector3d> next = scene.next_place();
  const auto seconds = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b, double turn) {
    return flight_time_s(b - a, turn, limits_);
  };
  problem.to_m = problem.to_s = problem.on_s = Eigen::VectorXd::Zero(count);
  problem.between_m = problem.between_s = Eigen::MatrixXd::Zero(count, count);
  for (int i = 0; i < count; ++i) {
    const Viewpoint& a = weighed.samples[i].viewpoint;
    problem.to_m[i] = (a.position - vehicle).norm();
    problem.to_s[i] = seconds(vehicle, a.position, a.yaw - scene.vehicle.yaw());
    if (next) problem.on_s[i] = seconds(a.position, *next, 0);
    for (int j = 0; j < count; ++j) {
      const Viewpoint& b = weighed.samples[j].viewpoint;
      problem.between_m(i, j) = (b.position - a.position).norm();
      problem.between_s(i, j) = seconds(a.position, b.position, b.yaw - a.yaw);
    }
  }
  if (next) problem.direct_s = seconds(vehicle, *next, 0);
  problem.dwell_s = config_.dwell_s;
  problem.drift_m = config_.drift_counts ? config_.drift_m : 0;
  problem.price_per_s = price_of(scene, weighed.targets.front());
  problem.horizon = config_.horizon;
  problem.most_paths = config_.most_paths;
  problem.beam = config_.beam;
}

/// What a second of flight to a target must bring, nat/s.
double PamsChooser::price_of(const ViewScene& scene, int target) const {
  const bool has_prior = !std::ranges::all_of(scene.targets, &Target::discovered);
  const bool beside_prior = scene.targets[target].discovered && has_prior;
  return beside_prior ? config_.discovered_price_per_s : config_.price_per_s;
}

/// The path to fly; that through the goal while nothing is better by a margin. None when no path
/// brings enough.
std::optional<Path> PamsChooser::best_path(const ViewScene& scene, const Weighed& weighed) const {
  if (weighed.samples.empty()) return std::nullopt;
  const Path best = choose_path(weighed.problem).best;
  const int last = static_cast<int>(weighed.samples.size()) - 1;
  const Viewpoint* goal = expected_goal(scene, weighed.targets.front());
  if (goal && weighed.samples[last].viewpoint.id == goal->id) {
    Path through_goal = choose_path(weighed.problem, last).best;
    const bool good_enough = through_goal.value >= best.value - config_.switch_gain;
    if (!config_.replan || good_enough) return through_goal;
  }
  if (best.stops.empty() || best.gain < config_.least_gain) return std::nullopt;
  return best;
}

/// What is predicted of the path's first viewpoint, before it is flown to.
Expectation PamsChooser::expect(const ViewScene& scene, const Weighed& weighed,
                                const Path& path) const {
  const int stop = path.stops.front();
  const Viewpoint& viewpoint = weighed.samples[stop].viewpoint;
  const int index = weighed.targets.front();
  const Target& target = scene.targets[index];
  const Eigen::MatrixXd common = model_.common(target.class_id);
  const Belief then = belief_of(scene, index).in_map(views_until(scene, viewpoint, index));
  Eigen::Matrix4d covariance = then.covariance();
  if (!config_.common_counts) covariance.topLeftCorner(common.rows(), common.cols()) += common;
  Expectation expected;
  expected.viewpoint_id = viewpoint.id;
  expected.target_id = target.id;
  expected.object_id = target.object_id;
  expected.gain = path_through(weighed.problem, {stop}).gain;
  expected.covariance = covariance.topLeftCorner(common.rows(), common.cols());
  return expected;
}

/// The views so far, those of the straight way to the viewpoint, on which other sides come by, and
/// that from there.
ViewHistory PamsChooser::views_until(const ViewScene& scene, const Viewpoint& viewpoint,
                                     int target) const {
  const Target& seen = scene.targets[target];
  const VehicleTrack& vehicle = scene.vehicle;
  const Eigen::Vector3d way = viewpoint.position - vehicle.position();
  const double turn = std::remainder(viewpoint.yaw - vehicle.yaw(), 2 * std::numbers::pi);
  const int steps = static_cast<int>(std::ceil(way.norm() / config_.way_step_m));
  const double seconds = flight_time_s(way, turn, limits_) / std::max(steps, 1);
  ViewHistory views = scene.records[target].history.so_far();
  for (int step = 0; step < steps; ++step) {
    const double share = (step + 0.5) / steps;
    const Eigen::Vector3d eye = vehicle.position() + share * way;
    if (!sampler_.sees(eye, vehicle.yaw() + share * turn, seen, scene.block, 0)) continue;
    views.add(eye, seen.place(), seconds, vehicle.flown_m() + share * way.norm());
  }
  views.add(viewpoint.position, seen.place(), config_.dwell_s, vehicle.flown_m() + way.norm());
  return views;
}

std::string PamsChooser::why_none(const ViewScene& scene, int target,
                                  const ViewChoice& choice) const {
  if (!scene.targets[target].mapped()) return search_.why_none(scene, target, choice);
  if (choice.well_known) return "known well enough";
  if (scene.records[target].goals >= config_.most_views) {
    return "as many viewpoints were flown to as may be";
  }
  const bool any = std::ranges::any_of(choice.candidates, [](const ViewpointCandidate& candidate) {
    return candidate.refusal == Refusal::none;
  });
  return any ? "no viewpoint in reach tells enough more" : count_refusals(choice.candidates);
}

std::string PamsChooser::seen_from(const ViewScene& scene, int target) const {
  const ViewRecord& record = scene.records[target];
  if (record.cells > 0) return "seen from " + std::to_string(record.cells) + " cells";
  const bool in_passing =
      scene.targets[target].mapped() && !record.history.so_far().dwells().empty();
  return in_passing ? "seen in passing" : search_.seen_from(scene, target);
}

}  // namespace saker::active
