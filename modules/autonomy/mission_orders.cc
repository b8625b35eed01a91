#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "saker/autonomy/mission.h"

// What orders do to the mission, and what it does while somebody else flies.
namespace saker::autonomy {
namespace {

constexpr double kAgreed_s = 1;   // from the agreement until the state says so, too
constexpr double kRegain_s = 10;  // PX4 wants 2 s of setpoints before it obeys them

bool others_fly(const MissionInput& input) { return (input.vehicle.faults & kTakenOver) != 0; }

bool is_down(const MissionInput& input) { return input.vehicle.stamp != 0 && !input.vehicle.armed; }

}  // namespace

Situation Mission::situation(const MissionInput& input) const {
  switch (phase_) {
    case MissionPhase::preflight:
      if (others_fly(input)) return Situation::not_ours;
      return standing_.held ? Situation::kept : Situation::preflight;
    case MissionPhase::arming:
      return Situation::arming;
    case MissionPhase::takeoff:
      return Situation::takeoff;
    case MissionPhase::tour:
      return Situation::tour;
    case MissionPhase::return_home:
      return standing_.recalled ? Situation::recalled : Situation::returning;
    case MissionPhase::hold:
      if (standing_.taken_over) return Situation::taken_over;
      return standing_.held && input.safety.action != SafetyAction::hold ? Situation::held
                                                                         : Situation::waiting;
    case MissionPhase::landing:
      return Situation::landing;
    case MissionPhase::done:
      break;
  }
  return Situation::done;
}

/// The one place at which orders act: at the end of a step, on what it came to.
void Mission::obey_orders(const MissionInput& input) {
  follow_take_back(input);
  follow_motors_off();
  for (const Order& order : input.orders) {
    if (const OrderReply* before = standing_.reply_to(order.id)) {
      out_.reply = *before;
      continue;
    }
    const OrderRuling ruled = ruling(situation(input), order.kind, input.safety);
    if (ruled.act == OrderAct::take_back) {
      begin_take_back(order, input);
      continue;
    }
    if (turns_off(ruled.act, input)) {
      out_.reply = standing_.keep({order, OrderState::waiting, "turns the motors off"});
      standing_.motors_off = OrderReply{order, OrderState::accepted, ruled.text};
    } else {
      const bool refused = ruled.act == OrderAct::refuse;
      reply(order, refused ? OrderState::refused : OrderState::accepted, ruled.text);
    }
    act(ruled.act, input);
  }
}

void Mission::reply(const Order& order, OrderState state, std::string text) {
  const bool refused = state == OrderState::refused;
  say(refused ? Cause::order_refused : Cause::ordered,
      fmt::format("{} {}: {}", to_string(order.kind), to_string(state), text));
  out_.reply = standing_.keep({order, state, std::move(text)});
}

void Mission::act(OrderAct act, const MissionInput& input) {
  switch (act) {
    case OrderAct::refuse:
    case OrderAct::nothing:
    case OrderAct::take_back:
      return;
    case OrderAct::keep:
    case OrderAct::disarm:
    case OrderAct::end:
      return act_on_the_ground(act, input);
    case OrderAct::hold:
      interrupted_ = phase_;
      hold_cause_ = Cause::ordered;
      go(MissionPhase::hold, Cause::ordered, "holds until another order");
      [[fallthrough]];
    case OrderAct::hold_later:
      standing_.held = true;
      standing_.held_since = now_;
      if (phase_ == MissionPhase::hold && standing_.since == 0) standing_.since = now_;
      return;
    case OrderAct::go_on:
      standing_.held = false;
      return;
    case OrderAct::tour_again:
      if (outcome_ == Cause::ordered || outcome_ == Cause::hold_deadline) outcome_ = Cause::landed;
      standing_.recalled = false;
      return_begun_ = 0;
      return go(MissionPhase::tour, Cause::ordered, "goes on with its tour");
    case OrderAct::return_home:
    case OrderAct::return_later:
      return recall(act == OrderAct::return_later, Cause::ordered, "ordered to return");
    case OrderAct::land:
      fail(Cause::ordered);
      return come_down(input, Cause::ordered, "ordered to land");
    case OrderAct::land_now:
      fail(Cause::ordered);
      return land(Cause::ordered, "ordered to come down at once");
  }
}

/// Whether the order needs motors off that run, or may.
bool Mission::turns_off(OrderAct act, const MissionInput& input) const {
  const bool stays = act == OrderAct::keep || act == OrderAct::disarm || act == OrderAct::end;
  return stays && (phase_ == MissionPhase::arming || input.vehicle.armed || standing_.motors_off);
}

void Mission::act_on_the_ground(OrderAct act, const MissionInput& input) {
  const bool motors = turns_off(act, input);
  standing_.held = act != OrderAct::end;
  standing_.ending = act == OrderAct::end && motors;
  if (act == OrderAct::end) fail(Cause::ordered);
  if (motors) {
    commands_.issue(CommandKind::disarm, NAN, now_);
    go(MissionPhase::preflight, Cause::ordered, "turns the motors off");
  } else if (act == OrderAct::end) {
    go(MissionPhase::done, Cause::ordered, "ended before take-off");
  }
}

void Mission::recall(bool later, Cause cause, core::Text text) {
  standing_.held = false;
  if (phase_ == MissionPhase::hold && interrupted_ == MissionPhase::return_home) return;
  fail(cause);
  standing_.recalled = true;
  if (later) {
    interrupted_ = MissionPhase::return_home;
  } else {
    run_own_time();
    go(MissionPhase::return_home, cause, std::move(text));
  }
}

/// On the ground, before anything else: true while it waits for an order, or for motors off.
bool Mission::stays_on_the_ground(const MissionInput& input) {
  if (standing_.ending) {
    if (commands_.progress() == CommandProgress::waiting) return true;
    const auto cause = failed_command();
    go(MissionPhase::done, cause.value_or(Cause::ordered),
       cause ? command_text() : "ended before take-off");
    return true;
  }
  if (!standing_.held || input.land_ordered) return false;
  begun_ = now_ - 1;  // its deadline waits, too
  clear_since_ = 0;
  return true;
}

/// At the end of the climb: true where an order waits for it.
bool Mission::holds_above() {
  if (!standing_.held) return false;
  interrupted_ = MissionPhase::tour;
  hold_cause_ = Cause::ordered;
  standing_.since = standing_.held_since = now_;
  go(MissionPhase::hold, Cause::ordered, "at its height; holds until another order");
  return true;
}

/// In a hold, where the ladder does not hold: true while an order does, or while the vehicle does
/// not obey setpoints after somebody else flew it.
bool Mission::stays_held(const MissionInput& input) {
  if (standing_.regaining) {
    const bool obeys = input.vehicle.mode == VehicleMode::guided;
    if (!obeys && !overdue(kRegain_s)) return true;
    standing_.regaining = false;
    if (!obeys) {
      standing_.held = true;
      standing_.held_since = now_;
      say(Cause::command_deadline,
          fmt::format("no setpoint is obeyed after {:g} s; holds until another order", kRegain_s));
    }
  }
  const bool home = input.safety.action == SafetyAction::return_home;
  if (standing_.held && !home) {
    if (now_ - standing_.held_since <= from_seconds(kOrderedHold_s)) return true;
    recall(false, Cause::hold_deadline,
           core::text("no other order for {:g} s; returns", kOrderedHold_s));
    if (phase_ != MissionPhase::hold) return true;
  }
  standing_.held = false;
  run_own_time();
  return false;
}

/// What an order, or a pilot, took of the mission's time is not of its deadlines.
void Mission::run_own_time() {
  if (standing_.since == 0) return;
  const Time away = now_ - std::exchange(standing_.since, 0);
  if (tour_begun_ != 0) tour_begun_ += away;
  if (return_begun_ != 0) return_begun_ += away;
}

/// True while a pilot, or a failsafe of the autopilot, flies: nothing that moves is sent, and the
/// mission goes on by an operator's order alone, whatever the vehicle says.
bool Mission::somebody_else_flies(const MissionInput& input) {
  if (!flying()) return false;
  if (others_fly(input) && !standing_.taken_over) hand_over();
  if (!standing_.taken_over) return false;
  if (is_down(input)) {
    fail(Cause::taken_over);
    go(MissionPhase::done, Cause::landed, "landed by who took over");
  } else if (now_ - input.plant_heard > from_seconds(config_.gone_s)) {
    fail(Cause::vehicle_silent);
    go(MissionPhase::done, Cause::vehicle_silent, "somebody else flies; nothing is heard of it");
  } else if (input.land_ordered && interrupted_ != MissionPhase::landing) {
    fail(Cause::ordered);
    interrupted_ = MissionPhase::landing;
    say(Cause::ordered, "lands when it is given back");
  }
  return true;
}

/// What was commanded before is not repeated into a pilot's hands.
void Mission::hand_over() {
  commands_.cancel();
  out_.command.reset();
  seeking_ = false;
  const bool climbs = phase_ == MissionPhase::takeoff;
  if (phase_ != MissionPhase::hold) interrupted_ = climbs ? MissionPhase::tour : phase_;
  if (standing_.since == 0) standing_.since = now_;
  standing_.taken_over = true;
  standing_.regaining = false;
  go(MissionPhase::hold, Cause::taken_over,
     "somebody else flies: nothing that moves is sent until an operator resumes");
}

/// An order on the ground is answered by what the flight controller says to it.
void Mission::follow_motors_off() {
  const bool asks = commands_.kind() == CommandKind::disarm;
  if (!standing_.motors_off || (asks && commands_.progress() == CommandProgress::waiting)) return;
  const OrderReply off = *std::exchange(standing_.motors_off, std::nullopt);
  if (!asks) {
    reply(off.order, OrderState::refused, "another command took its place");
  } else if (failed_command()) {
    reply(off.order, OrderState::refused, command_text());
  } else {
    reply(off.order, off.state, off.text);
  }
}

/// Where the ladder would land or hold at once, who flies keeps it; a landing goes on unless the
/// place is lost.
void Mission::begin_take_back(const Order& order, const MissionInput& input) {
  const bool lands = interrupted_ == MissionPhase::landing;
  const SafetyAction least = lands ? SafetyAction::silence : SafetyAction::hold;
  const auto bars =
      std::find_if(input.findings.begin(), input.findings.end(),
                   [least](const Finding& finding) { return finding.action >= least; });
  if (flying() && bars != input.findings.end()) {
    reply(order, OrderState::refused, fmt::format("{}: {}", to_string(bars->cause), bars->text));
    return;
  }
  standing_.taking_back = order;
  standing_.taken_back = 0;
  commands_.issue(CommandKind::resume, NAN, now_);
  out_.reply = standing_.keep({order, OrderState::waiting, "asks the flight controller"});
}

void Mission::follow_take_back(const MissionInput& input) {
  if (!standing_.taking_back || commands_.progress() == CommandProgress::waiting) return;
  const Order order = *standing_.taking_back;
  const bool agreed = !failed_command();
  if (agreed && standing_.taken_back == 0) standing_.taken_back = now_;
  const bool waits =
      agreed && others_fly(input) && now_ - standing_.taken_back < from_seconds(kAgreed_s);
  if (waits) return;
  standing_.taking_back.reset();
  if (!agreed || others_fly(input)) {
    reply(order, OrderState::refused, agreed ? "somebody took it over again" : command_text());
    return;
  }
  reply(order, OrderState::accepted, order_rule(situation(input), order.kind).text);
  regain();
}

void Mission::regain() {
  standing_.held = false;
  if (!std::exchange(standing_.taken_over, false)) return;  // on the ground
  if (interrupted_ == MissionPhase::landing) {
    land(Cause::ordered, "goes on landing");
    return;
  }
  standing_.regaining = true;
  begun_ = now_;
  out_.anchor = true;
}

}  // namespace saker::autonomy
