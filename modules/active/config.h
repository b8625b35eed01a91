#pragma once

#include <string>
#include <vector>

#include "saker/active/discovery/discovery_config.h"
#include "saker/active/tour/targets.h"
#include "saker/active/tour/tour.h"
#include "saker/active/views/pams_config.h"
#include "saker/active/views/viewpoint.h"
#include "saker/core/config.h"
#include "saker/uncertainty/regions.h"

/// Settings of the stage: one group for each of its parts, and the policy that chooses viewpoints.
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

/// The configuration where it makes sense; throws Error, with the key, where it does not.
[[nodiscard]] ActiveConfig checked(const ActiveConfig& config);

/// The settings of a policy by information gain; policy `visit` has none.
[[nodiscard]] inline const PamsConfig& pams_of(const ActiveConfig& config) {
  return config.policy == PolicyName::paper ? config.paper : config.saker;
}

}  // namespace saker::active
