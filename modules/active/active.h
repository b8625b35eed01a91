#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "saker/active/discovery_config.h"
#include "saker/active/pams_config.h"
#include "saker/active/targets.h"
#include "saker/active/tour.h"
#include "saker/active/viewpoint.h"
#include "saker/core/budget.h"
#include "saker/core/config.h"
#include "saker/core/time.h"
#include "saker/motion/limits.h"
#include "saker/uncertainty/regions.h"
#include "saker/uncertainty/uncertainty.h"

/// Stage 6: where to look next — reads the object map (from `slam`), the occupancy block (from the
/// collision checker) and the vehicle's pose at 1 Hz, makes the viewpoint to fly to (for `motion`
/// and the mission).
///
/// Frames: prior map, object map, viewpoints and geofence are in `world`, the block is in `odom`.
/// Method: the paper, "PAMS": a tour over the prior map's targets; what is done at each of them is
/// the policy's. Cost: a few milliseconds a decision, a tour of 1,000 targets about a second.
namespace saker::active {

enum class PolicyName { visit, paper, saker };

[[nodiscard]] inline std::vector<std::string> enum_names(PolicyName) {
  return {"visit", "paper", "saker"};
}

/// What all policies do about viewpoints to which the vehicle does not come.
struct GoalsConfig {
  double patience_s = 20;
  double standing_s = 8;
  double progress_m = 0.5;
  double refused_m = 3;
  int most_refusals = 3;
  int most_goals = 12;
  int attempts = 2;
  bool return_home = true;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("patience_s", patience_s, {1, 600}, "s",
            "without coming nearer or seeing something new, until a viewpoint is given up");
    v.field("standing_s", standing_s, {1, 600}, "s",
            "the same for a vehicle that stands: more than two dwells, for a place may lie between "
            "two directions");
    v.field("progress_m", progress_m, {0.05, 10}, "m", "that count as nearer");
    v.field("refused_m", refused_m, {0, 20}, "m",
            "around a viewpoint that was given up none is tried: it would be given up as well");
    v.field("most_refusals", most_refusals, {1, 50}, "",
            "viewpoints given up in flight, until the target is");
    v.field("most_goals", most_goals, {1, 200}, "",
            "viewpoints flown to without seeing anything new, until the target is given up: no "
            "dithering");
    v.field("attempts", attempts, {1, 5}, "",
            "at a target that was seen from nowhere: the later ones when all others are closed");
    v.setting("return_home", return_home, "", "The tour ends where it began.");
  }
};

/// The baseline: visits each target of the prior map.
struct VisitConfig {
  int sides = 1;
  double separation_deg = 120;
  bool between = false;
  double dwell_s = 3.0;
  double oblique_worth_m = 0;
  double unknown_worth_m = 5;
  double switch_m = 5;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("sides", sides, {1, 4}, "",
            "from which a target is seen: the paper's baseline visits each place once. From two "
            "opposite corners all four edges are seen");
    v.field("separation_deg", separation_deg, {10, 180}, "deg",
            "least angle between sides, at most 180 / (sides − 1): each finds room then");
    v.field("between", between, "",
            "whether a vehicle of which nobody has seen how long it is is looked at from more "
            "sides, half as far apart, when there are no others");
    v.field("dwell_s", dwell_s, {0, 60}, "s",
            "in view from a side: five windows, after which SLAM believes in an object");
    v.field("oblique_worth_m", oblique_worth_m, {0, 100}, "m",
            "detour for an oblique instead of a straight view, which shows length and width at "
            "once: 0 for the baseline, which knows nothing of views");
    v.field("unknown_worth_m", unknown_worth_m, {0, 100}, "m",
            "detour for a viewpoint that is known to be free");
    v.field("switch_m", switch_m, {0, 100}, "m",
            "a viewpoint must be better by this to replace the one that is flown to");
  }
};

struct ActiveConfig {
  PolicyName policy = PolicyName::saker;
  TargetsConfig targets;
  TourConfig tour;
  FieldOfViewConfig view;
  ViewpointConfig viewpoints;
  GoalsConfig goals;
  VisitConfig visit_policy;
  uncertainty::RegionConfig region;
  PamsConfig paper = PamsConfig::paper();
  PamsConfig saker = PamsConfig::saker();
  DiscoveryConfig discovery;

  template <class Visitor>
  void visit(Visitor& v) {
    v.setting("policy", policy, "",
              "Viewpoints are chosen as the best of this project (saker), as in the paper (paper), "
              "or by visiting each target (visit).");
    v.group("targets", targets, "what is to be mapped");
    v.group("tour", tour, "in which order");
    v.group("view", view, "the sensor's field of view");
    v.group("viewpoints", viewpoints, "places to look from");
    v.group("goals", goals, "viewpoints that are flown to, whatever the policy");
    v.group("visit", visit_policy, "policy visit: every target, from one side or several");
    v.group("region", region, "of good views, for the policies that follow");
    v.group("paper", paper, "policy paper: PAMS as the paper has it");
    v.group("saker", saker, "policy saker: PAMS with the price of time, drift, several at once");
    v.group("discovery", discovery, "where the prior map is wrong, incomplete or absent");
  }
};

/// Where and when what is decided now begins to be flown: until then, what was committed before.
struct ActiveStart {
  Time stamp = 0;
  SE3 T_world_body = SE3::Identity();
};

/// What a decision is made from. `map` and `grid` may be absent at first.
struct ActiveInput {
  Time stamp = 0;
  SE3 T_world_body = SE3::Identity();
  SE3 T_world_odom = SE3::Identity();
  std::optional<ActiveStart> start;               ///< none: where the vehicle is
  std::shared_ptr<const objects::ObjectMap> map;  ///< world
  std::optional<Time> map_stamp;  ///< until when it holds what was measured; none: until now
  std::shared_ptr<const occupancy::OccupancyGrid> grid;  ///< odom
};

enum class ActiveStatus {
  flying,    ///< fly to `goal`, and stay there until it changes
  finished,  ///< no target is pending
  invalid,   ///< a pose that is not finite, or a stamp that is not newer: nothing changed
};

/// What was predicted of a viewpoint before it was flown to.
struct Expectation {
  int viewpoint_id = -1;
  int target_id = -1;
  int object_id = -1;          ///< of the mapped object
  Time seen_until = 0;         ///< its target from there, once it was flown to
  double gain = NAN;           ///< nat, off the entropies of all targets that are seen from there
  Eigen::MatrixXd covariance;  ///< after it, as uncertainty::Prediction's and with the common part
};

/// A decision, with all that led to it.
struct ActivePlan {
  ActiveStatus status = ActiveStatus::invalid;
  std::optional<Viewpoint> goal;  ///< while flying
  std::vector<int> tour;          ///< ids of the pending targets in their order, the goal's first
  double tour_length_m = 0;       ///< straight lines, with the way home
  std::vector<Candidate> candidates;    ///< for the goal's target
  std::optional<Expectation> expected;  ///< of the goal, where the policy has a model
  std::vector<Expectation> flown;       ///< viewpoints that were seen from since the last decision
  int pending = 0, done = 0, visited = 0, unreachable = 0;
  double seen_share = NAN;  ///< of the geofence, where it is swept
};

/// Chooses viewpoints. One object a mission; a function of the calls so far.
class Policy {
 public:
  virtual ~Policy() = default;

  /// At 1 Hz throughout the tour, also under way: what comes into view counts.
  [[nodiscard]] virtual ActivePlan plan(const ActiveInput& input, const core::Budget& budget) = 0;

  /// Motion planning found no way to this viewpoint: it is not offered again.
  virtual void refuse(int viewpoint_id, const std::string& reason) = 0;

  [[nodiscard]] virtual const std::vector<Target>& targets() const = 0;

  /// Whether there is nothing to fly for, from the beginning.
  [[nodiscard]] virtual bool idle() const { return targets().empty(); }
};

/// A policy over targets that may come and go between two decisions: discovery adds and dismisses.
class TargetPolicy : public Policy {
 public:
  [[nodiscard]] virtual TargetList& target_list() = 0;
};

/// Throws Error on an invalid configuration or prior map; for policies `paper` and `saker` also
/// without a model, or with one that lacks a target class.
/// \param model  what views are worth; may be null for policy `visit`.
/// \param limits  from which flight times follow.
[[nodiscard]] std::unique_ptr<TargetPolicy> make_policy(
    const ActiveConfig& config, const objects::ClassTable& table, const objects::ObjectMap& prior,
    InGeofence in_geofence, std::shared_ptr<const uncertainty::Model> model = nullptr,
    const motion::LimitsConfig& limits = {});

}  // namespace saker::active
