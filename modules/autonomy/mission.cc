#include "saker/autonomy/mission.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace saker::autonomy {
namespace {

constexpr double kSeen_s = 2.5;     // planning looks every second
constexpr double kSame_m = 0.5;     // from the place that was judged
constexpr double kRests_mps = 0.6;  // 0.1 m to a stop

}  // namespace

const char* to_string(MissionPhase phase) {
  constexpr const char* kNames[] = {"preflight", "arming", "takeoff", "tour",
                                    "return",    "hold",   "landing", "done"};
  return kNames[static_cast<int>(phase)];
}

Mission::Mission(const MissionConfig& config)
    : config_(core::checked(config, "mission")), commands_(config_.command) {}

bool Mission::flying() const {
  return phase_ > MissionPhase::arming && phase_ != MissionPhase::done;
}

bool Mission::overdue(double seconds) const { return now_ - begun_ > from_seconds(seconds); }

void Mission::say(Cause cause, core::Text text) {
  out_.events.push_back({now_, phase_, phase_, cause, std::move(text)});
}

void Mission::go(MissionPhase phase, Cause cause, core::Text text) {
  out_.events.push_back({now_, phase_, phase, cause, std::move(text)});
  phase_ = phase;
  begun_ = now_;
}

/// Not what was planned: the first such cause is the outcome.
void Mission::fail(Cause cause) {
  if (outcome_ == Cause::landed) outcome_ = cause;
}

void Mission::land(Cause cause, core::Text text) {
  seeking_ = false;
  go(MissionPhase::landing, cause, std::move(text));
  if (!silent_) commands_.issue(CommandKind::land, NAN, now_);
}

Mission::Output Mission::step(const MissionInput& input) {
  out_ = {};
  now_ = input.now;
  if (begun_ == 0) begun_ = now_;
  out_.command = commands_.step(now_, input.acks);
  say_stop(input.stop);
  if (!somebody_else_flies(input) && (!flying() || !obey_safety(input))) {
    switch (phase_) {
      case MissionPhase::preflight:
        preflight(input);
        break;
      case MissionPhase::arming:
        arming(input);
        break;
      case MissionPhase::takeoff:
        takeoff(input);
        break;
      case MissionPhase::tour:
        tour(input);
        break;
      case MissionPhase::return_home:
        return_home(input);
        break;
      case MissionPhase::hold:
        hold(input);
        break;
      case MissionPhase::landing:
        landing(input);
        break;
      case MissionPhase::done:
        break;
    }
  }
  obey_orders(input);
  if (!out_.command) out_.command = commands_.step(now_, {});  // one issued just now
  out_.orders = orders();
  return std::exchange(out_, {});
}

MissionOrders Mission::orders() const {
  switch (phase_) {
    case MissionPhase::tour:
      return {GuidanceOrder::follow, PlanningOrder::tour};
    case MissionPhase::return_home:
      return {GuidanceOrder::follow, PlanningOrder::home};
    case MissionPhase::landing:
      if (!seeking_) return {};
      return {rests_ ? GuidanceOrder::follow : GuidanceOrder::hold, PlanningOrder::land};
    case MissionPhase::hold:
      return {standing_.taken_over ? GuidanceOrder::silent : GuidanceOrder::hold,
              PlanningOrder::none};
    default:
      return {};
  }
}

void Mission::preflight(const MissionInput& input) {
  if (stays_on_the_ground(input)) return;
  core::Text faults;
  for (const Finding& finding : input.findings) {
    faults +=
        core::text("{}{}: {}", faults.empty() ? "" : "; ", to_string(finding.cause), finding.text);
  }
  const Cause first = input.findings.empty() ? Cause::ready : input.findings.front().cause;
  if (first != Cause::ready) clear_since_ = 0;
  if (first == Cause::ready && clear_since_ == 0) clear_since_ = now_;
  if (first != fault_ || begun_ == now_) say(first, faults.empty() ? "nothing is missing" : faults);
  fault_ = first;

  if (input.land_ordered) {
    fail(Cause::ordered);
    go(MissionPhase::done, Cause::ordered, "ended before take-off");
  } else if (input.marked && input.looked_up && clear_since_ != 0 &&
             now_ - clear_since_ >= from_seconds(config_.settle_s)) {
    go(MissionPhase::arming, Cause::ready, "all is there");
    commands_.issue(CommandKind::arm, NAN, now_);
  } else if (overdue(config_.preflight_s)) {
    fail(Cause::preflight_deadline);
    if (faults.empty() && !input.looked_up) faults = "nobody has looked at the column above";
    if (faults.empty() && !input.marked) faults = "the flight could not be marked";
    go(MissionPhase::done, Cause::preflight_deadline, "no take-off: " + faults);
  }
}

/// A command that failed ends the wait for what it should have brought about.
std::optional<Cause> Mission::failed_command() const {
  if (commands_.progress() == CommandProgress::refused) return Cause::command_refused;
  if (commands_.progress() == CommandProgress::expired) return Cause::command_deadline;
  return std::nullopt;
}

core::Text Mission::command_text() const {
  if (commands_.progress() == CommandProgress::expired) {
    return core::text("{}: no answer for {:g} s", to_string(commands_.kind()),
                      config_.command.deadline_s);
  }
  return core::text("{}: {}", to_string(commands_.kind()), commands_.reason());
}

void Mission::arming(const MissionInput& input) {
  if (const auto cause = failed_command()) {
    fail(*cause);
    go(MissionPhase::done, *cause, command_text());
  } else if (commands_.progress() == CommandProgress::accepted && input.vehicle.armed) {
    go(MissionPhase::takeoff, Cause::armed, core::text("to {:g} m", config_.height_m));
    takeoff_floor_m_ = input.odometry.T_odom_body.translation().z();
    commands_.issue(CommandKind::takeoff, config_.height_m, now_);
  } else if (overdue(std::max(config_.takeoff_s, config_.command.deadline_s))) {
    fail(Cause::command_deadline);
    go(MissionPhase::done, Cause::command_deadline, "arm: accepted, but it did not arm");
  }
}

void Mission::takeoff(const MissionInput& input) {
  const double height = input.odometry.T_odom_body.translation().z() - takeoff_floor_m_;
  if (const auto cause = failed_command()) {
    fail(*cause);
    land(*cause, command_text());
  } else if (height > config_.height_m - config_.height_tolerance_m) {
    out_.anchor = true;
    if (!holds_above()) go(MissionPhase::tour, Cause::took_off, core::text("at {:.1f} m", height));
  } else if (overdue(config_.takeoff_s)) {
    fail(Cause::takeoff_deadline);
    land(Cause::takeoff_deadline,
         core::text("at {:.1f} m after {:g} s", height, config_.takeoff_s));
  }
}

void Mission::tour(const MissionInput& input) {
  const PlanningReport& plan = input.planning;
  if (tour_begun_ == 0) tour_begun_ = now_;
  if (plan.order == PlanningOrder::tour && plan.status == PlanningStatus::tour_complete) {
    go(MissionPhase::return_home, Cause::tour_complete, plan.text);
  } else if (plan.order == PlanningOrder::tour &&
             plan.status == PlanningStatus::nothing_reachable) {
    fail(Cause::nothing_reachable);
    go(MissionPhase::return_home, Cause::nothing_reachable, plan.text);
  } else if (now_ - tour_begun_ > from_seconds(config_.tour_s)) {
    fail(Cause::tour_deadline);
    go(MissionPhase::return_home, Cause::tour_deadline,
       core::text("{} of {} targets after {:g} s", plan.visited, plan.targets, config_.tour_s));
  }
}

void Mission::return_home(const MissionInput& input) {
  const PlanningReport& plan = input.planning;
  if (return_begun_ == 0) return_begun_ = now_;
  if (plan.order == PlanningOrder::home && plan.status == PlanningStatus::home_reached) {
    come_down(input, Cause::home_reached, plan.text);
  } else if (plan.order == PlanningOrder::home && plan.status == PlanningStatus::home_unreachable) {
    fail(Cause::home_unreachable);
    come_down(input, Cause::home_unreachable, "lands here: " + plan.text);
  } else if (now_ - return_begun_ > from_seconds(config_.return_s)) {
    fail(Cause::return_deadline);
    come_down(input, Cause::return_deadline, core::text("not home after {:g} s", config_.return_s));
  }
}

/// Safety says when it ends, or an order does.
void Mission::hold(const MissionInput& input) {
  if (input.safety.action == SafetyAction::hold || stays_held(input)) return;
  const bool home = input.safety.action == SafetyAction::return_home;
  if (home) fail(input.safety.cause);
  go(home ? MissionPhase::return_home : interrupted_, home ? input.safety.cause : Cause::recovered,
     home ? input.safety.text : "goes on");
  out_.anchor = hold_cause_ == Cause::off_course;
}

/// True when safety, or the operator, changed the phase.
bool Mission::obey_safety(const MissionInput& input) {
  const SafetyDecision& safety = input.safety;
  if (safety.action == SafetyAction::silence && !silent_) {
    silent_ = true;
    fail(safety.cause);
    if (phase_ == MissionPhase::landing) say(safety.cause, safety.text + "; no more setpoints");
  }
  if (phase_ == MissionPhase::landing) {
    if (seeking_ && safety.action >= SafetyAction::hold) {
      fail(safety.cause);
      land(safety.cause, safety.text + "; lands here");
    }
    return false;
  }
  if (safety.action >= SafetyAction::land) {
    fail(safety.cause);
    land(safety.cause, safety.text);
  } else if (input.land_ordered) {
    fail(Cause::ordered);
    land(Cause::ordered, "ordered to land");
  } else if (safety.action == SafetyAction::hold && phase_ != MissionPhase::hold) {
    begin_hold(safety);
  } else if (safety.action == SafetyAction::return_home && phase_ == MissionPhase::tour) {
    fail(safety.cause);
    go(MissionPhase::return_home, safety.cause, safety.text);
  } else {
    return false;
  }
  return true;
}

void Mission::begin_hold(const SafetyDecision& safety) {
  if (phase_ == MissionPhase::takeoff) {  // the flight controller climbs: there is nothing to hold
    fail(safety.cause);
    land(safety.cause, safety.text);
  } else if (++holds_ > config_.most_holds) {
    fail(Cause::too_many_holds);
    land(Cause::too_many_holds, core::text("{} holds; {}", holds_, safety.text));
  } else {
    interrupted_ = phase_;
    hold_cause_ = safety.cause;
    go(MissionPhase::hold, safety.cause, safety.text);
  }
}

/// A hold has said why already.
void Mission::say_stop(const GuidanceStop& stop) {
  if (stop.count != stops_ && phase_ != MissionPhase::hold) say(Cause::stopped, stop.reason);
  stops_ = stop.count;
}

/// With time to look where: at once where the place below is fit, and in the climb, which the
/// flight controller would go on with while no setpoint is there to hold it.
void Mission::come_down(const MissionInput& input, Cause cause, core::Text text) {
  if (phase_ == MissionPhase::takeoff || below_is_fit(input)) return land(cause, std::move(text));
  const LandingPlace& below = input.planning.landing;
  ground_ = below.ground;
  go(MissionPhase::landing, cause, text + "; looks for a place: " + below.text());
  seeking_ = true;
  rests_ = false;
}

/// By what planning saw of it a moment ago, at rest.
bool Mission::below_is_fit(const MissionInput& input) const {
  const LandingPlace& below = input.planning.landing;
  const Eigen::Vector3d off = input.odometry.T_odom_body.translation() - below.above;
  return below.fit() && now_ - input.planning.stamp <= from_seconds(kSeen_s) &&
         off.head<2>().norm() <= kSame_m && input.odometry.velocity.norm() <= kRests_mps;
}

/// True while it looks for a place to land on.
bool Mission::seeks(const MissionInput& input) {
  if (!seeking_) return false;
  rests_ = rests_ || input.odometry.velocity.norm() <= kRests_mps;
  const LandingPlace& below = input.planning.landing;
  if (below_is_fit(input)) {
    land(Cause::recovered, "the ground is fit here: lands");
  } else if (overdue(config_.place_s)) {
    fail(Cause::place_unfit);
    land(Cause::place_unfit,
         core::text("no fit place for {:g} s: lands here; ", config_.place_s) + below.text());
  } else if (input.planning.order == PlanningOrder::land && below.ground != ground_ &&
             !below.fit()) {
    ground_ = below.ground;
    say(Cause::place_unfit, "hovers: " + input.planning.text);
  }
  return true;
}

void Mission::landing(const MissionInput& input) {
  const bool down = input.vehicle.stamp != 0 && !input.vehicle.armed;
  if (!down && seeks(input)) return;
  if (down) {
    go(MissionPhase::done, Cause::landed, core::text("outcome: {}", to_string(outcome_)));
  } else if (now_ - input.plant_heard > from_seconds(config_.gone_s)) {
    fail(Cause::vehicle_silent);
    go(MissionPhase::done, Cause::vehicle_silent,
       core::text("neither vehicle nor lidar for {:g} s: nothing is left to be flown; outcome: {}",
                  config_.gone_s, to_string(outcome_)));
  } else if (overdue(config_.landing_s)) {
    fail(Cause::landing_deadline);
    say(Cause::landing_deadline,
        core::text("still up after {:g} s; told to land again", config_.landing_s));
    begun_ = now_;
    commands_.issue(CommandKind::land, NAN, now_);
  } else if (failed_command() && !silent_ && !land_refusal_said_) {
    land_refusal_said_ = true;
    fail(*failed_command());
    say(*failed_command(), command_text() + "; without setpoints it lands by itself");
  }
}

}  // namespace saker::autonomy
