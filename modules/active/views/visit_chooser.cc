#include "saker/active/views/visit_chooser.h"

#include <algorithm>
#include <numbers>
#include <utility>

#include "saker/core/se3.h"

namespace saker::active {
namespace {

constexpr double kRadians = std::numbers::pi / 180;

}  // namespace

VisitChooser::VisitChooser(const VisitConfig& config, ViewpointSampler sampler)
    : config_(config), sampler_(std::move(sampler)) {}

ViewRecord VisitChooser::unseen() const {
  const ViewpointConfig& viewpoints = sampler_.config();
  const ViewHistory none(viewpoints.bearings, viewpoints.ring_step_m);
  return {Sides(viewpoints.bearings, config_.dwell_s, config_.separation_deg * kRadians),
          MappedViewHistory(none)};
}

ViewOutcome VisitChooser::observe(const ViewScene& scene, int target, ViewRecord& record) const {
  const Target& seen = scene.targets[target];
  const Eigen::Vector3d to_vehicle = scene.vehicle.position() - seen.place();
  const double bearing = std::atan2(to_vehicle.y(), to_vehicle.x());
  ViewOutcome outcome;
  outcome.is_new = record.sides.add(bearing, scene.vehicle.elapsed_s());
  const bool all = record.sides.count() >= config_.sides;
  outcome.target_done = outcome.is_new && all && !end_is_missing(seen);
  return outcome;
}

/// A visit is a visit, whatever the map says of the target later.
bool VisitChooser::reopens(const ViewScene& /*scene*/, int /*target*/) const { return false; }

ViewChoice VisitChooser::choose(const ViewScene& scene, int target) const {
  const Sides& sides = scene.records[target].sides;
  ViewChoice choice = choose_side(scene, target, sides);
  if (choice.verdict != ViewChoice::Verdict::none) return choice;
  if (!end_is_missing(scene.targets[target]) || sides.count() == 0) return choice;
  Sides closer = sides;
  closer.also_between();
  choice = choose_side(scene, target, closer);
  choice.between_sides = true;
  return choice;
}

/// Such a target is worth more sides than others.
bool VisitChooser::end_is_missing(const Target& target) const {
  return config_.between && target.incomplete();
}

ViewChoice VisitChooser::choose_side(const ViewScene& scene, int target, const Sides& sides) const {
  ViewChoice choice;
  choice.candidates = sampler_.around(scene.targets[target], target, scene.block);
  const ViewpointCandidate* best = nullptr;
  for (ViewpointCandidate& candidate : choice.candidates) {
    judge(scene, target, sides, candidate);
    if (candidate.refusal != Refusal::none) continue;
    if (!best || score(candidate) < score(*best)) best = &candidate;
  }
  if (keeps_goal(scene, target, sides, best)) {
    choice.verdict = ViewChoice::Verdict::keep_goal;
  } else if (best) {
    choice.verdict = ViewChoice::Verdict::fly;
    choice.viewpoint = best->viewpoint;
  }
  return choice;
}

/// The goal is kept while it is good, and hardly worse than the best.
bool VisitChooser::keeps_goal(const ViewScene& scene, int target, const Sides& sides,
                              const ViewpointCandidate* best) const {
  const Viewpoint* goal = scene.goal(target);
  if (!goal) return false;
  ViewpointCandidate current = sampler_.goal(*goal, scene.targets[target], scene.block);
  judge(scene, target, sides, current);
  if (current.refusal != Refusal::none) return false;
  return !best || score(current) <= score(*best) + config_.switch_m;
}

/// Adds the refusals that depend on the flight so far. The gain says how obliquely the target is
/// seen, 0 … 1.
void VisitChooser::judge(const ViewScene& scene, int target, const Sides& sides,
                         ViewpointCandidate& candidate) const {
  const Target& seen = scene.targets[target];
  const Viewpoint& viewpoint = candidate.viewpoint;
  candidate.cost_m = (scene.vehicle.position() - viewpoint.position).norm();
  if (sides.count() + 1 >= config_.sides && scene.tour.size() > 1) {
    candidate.cost_m += (scene.targets[scene.tour[1]].place() - viewpoint.position).norm();
  }
  const double heading = core::yaw(seen.extent.pose.linear());
  candidate.gain = seen.mapped() ? std::abs(std::sin(2 * (viewpoint.bearing - heading))) : 0;
  if (candidate.refusal != Refusal::none) return;
  if (scene.states[target].gave_up(viewpoint.position)) candidate.refusal = Refusal::motion;
  if (!sides.apart(viewpoint.bearing)) candidate.refusal = Refusal::seen;
}

double VisitChooser::score(const ViewpointCandidate& candidate) const {
  return candidate.cost_m - config_.oblique_worth_m * candidate.gain -
         (candidate.known_free ? config_.unknown_worth_m : 0);
}

std::string VisitChooser::why_none(const ViewScene& /*scene*/, int /*target*/,
                                   const ViewChoice& choice) const {
  return count_refusals(choice.candidates);
}

std::string VisitChooser::seen_from(const ViewScene& scene, int target) const {
  const int sides = scene.records[target].sides.count();
  if (sides == 0) return "";
  const int wanted = std::max(config_.sides, sides);
  return "seen from " + std::to_string(sides) + " of " + std::to_string(wanted) + " sides";
}

}  // namespace saker::active
