#include "tools/sim/mavlink/autopilot.h"

#include <algorithm>

#include "flight/mavlink/codec.h"
#include "saker/core/se3.h"

namespace saker::tools {
namespace {

using namespace flight::mavlink;

constexpr double kReached = 0.2;       // m below the height of a take-off
constexpr double kClimbWanted = 0.3;   // m above the ground that setpoints have to ask for
constexpr double kLeastTakeoff = 0.5;  // m, of the inner loops
constexpr double kInnerLate = 0.1;     // s that the inner loops' mode is behind an order
constexpr double kNotArmed = 1;        // s that the inner loops may take to arm

Eigen::Vector3d place_of(const CraftState& craft) { return craft.T_odom_body.translation(); }

double yaw_of(const CraftState& craft) { return core::yaw(craft.T_odom_body.linear()); }

}  // namespace

void SimulatedAutopilot::step(Time vehicle_now, const CraftState& craft) {
  if (dead_) return;
  now_ = vehicle_now - boot_;
  craft_ = craft;
  if (armed_) {
    watch();
    if (quirks_.dialect.own_takeoff)
      climb();
    else
      climb_by_setpoints();
    follow_landing();
    follow_setpoints();
  }
  if (const auto question = estimator_.question(now_)) say(*question);
  for (const std::uint32_t id : streams_.due(now_)) say(id);
}

void SimulatedAutopilot::order(CommandKind kind, double height_m) {
  orders_.commands.push_back({boot_ + now_, ++last_order_, kind, height_m});
}

// Modes.

std::uint32_t SimulatedAutopilot::first_mode(const Quirks& quirks) {
  return quirks.modes.empty() ? 0 : quirks.modes.front();
}

AckResult SimulatedAutopilot::request_mode(std::uint32_t custom_mode) {
  const Dialect& d = quirks_.dialect;
  const bool of_dialect = custom_mode == d.guided.custom || custom_mode == d.hold.custom ||
                          custom_mode == d.land.custom;
  const bool exists =
      of_dialect || std::count(quirks_.modes.begin(), quirks_.modes.end(), custom_mode) > 0;
  if (!exists) {
    text(4, "No such mode " + std::to_string(custom_mode));
    return quirks_.no_such_mode;
  }
  if (custom_mode == d.guided.custom && quirks_.guided_needs_stream && !guided_.streamed(now_))
    return quirks_.refusal;
  const bool needs_origin = custom_mode == d.hold.custom && quirks_.hold_needs_origin;
  if (needs_origin && armed_ && !estimator_.has_origin(now_)) return quirks_.refusal;
  enter(custom_mode);
  return AckResult::accepted;
}

void SimulatedAutopilot::enter(std::uint32_t custom_mode) {
  if (custom_mode == mode_) return;
  const bool was_landing = landing();
  mode_ = custom_mode;
  mode_at_ = now_;
  if (armed_ && flying() && !touched_at_) {
    if (landing()) descends_at_ = now_;
    if (was_landing) {
      descends_at_.reset();
      order(CommandKind::hold);
      landed_ = Landed::in_air;
    }
  }
  if (!guided() || !quirks_.guided_needs_stream) guided_.hold(place_of(craft_), yaw_of(craft_));
  climb_ = climb_ == Climb::spooling ? Climb::none : climb_;
  say(Heartbeat::kId);
}

void SimulatedAutopilot::switch_mode(std::uint32_t custom_mode, bool critical) {
  critical_ = critical;
  enter(custom_mode);
}

void SimulatedAutopilot::fail_safe(int severity, const std::string& words) {
  critical_ = true;
  enter(quirks_.dialect.land.custom);
  if (descends_at_) *descends_at_ += from_seconds(quirks_.failsafe_pause_s);
  text(severity, words);
}

/// What makes it land by itself.
void SimulatedAutopilot::watch() {
  if (!flying() || landing() || touched_at_) return;
  const VehicleMode mode = craft_.vehicle.mode;
  const bool inner =
      since(mode_at_) > kInnerLate && (mode == VehicleMode::land || mode == VehicleMode::descend);
  if (estimator_.lost(now_) || inner) return fail_safe(2, quirks_.lost_text);
  const bool station = quirks_.ground_station_s > 0 && ground_station_at_;
  if (station && since(*ground_station_at_) > quirks_.ground_station_s)
    return fail_safe(4, "GCS Failsafe");
  if (guided() && !quirks_.flies_on && !guided_.streamed(now_)) fail_safe(2, quirks_.lost_text);
}

// Arming.

std::vector<std::string> SimulatedAutopilot::arming_refusals() const {
  std::vector<std::string> causes;
  const bool hold = mode_ == quirks_.dialect.hold.custom;
  const bool needs_home = quirks_.dialect.own_takeoff || (hold && quirks_.hold_needs_origin);
  if (!estimator_.runs(now_)) causes.emplace_back(quirks_.no_height);
  if (needs_home && !estimator_.has_origin(now_)) causes.emplace_back(quirks_.no_home);
  if (estimator_.runs(now_) && !estimator_.aided(now_)) causes.emplace_back(quirks_.no_odometry);
  for (const ArmingCheck& check : quirks_.checks)
    if (to_seconds(now_) < check.until_s) {
      causes.emplace_back(check.text);
      break;
    }
  causes.erase(std::unique(causes.begin(), causes.end()), causes.end());
  return causes;
}

AckResult SimulatedAutopilot::arm() {
  if (armed_) return AckResult::accepted;
  const std::vector<std::string> causes = arming_refusals();
  for (const std::string& cause : causes) text(2, cause);
  if (!causes.empty()) return quirks_.refusal;
  armed_ = true;
  critical_ = false;
  armed_at_ = now_;
  touched_at_.reset();
  order(CommandKind::arm);
  text(6, quirks_.armed_text);
  return AckResult::accepted;
}

AckResult SimulatedAutopilot::disarm_ordered() {
  if (armed_ && flying()) return quirks_.refusal;
  if (armed_) disarm();
  return AckResult::accepted;
}

void SimulatedAutopilot::disarm() {
  armed_ = false;
  climb_ = Climb::none;
  touched_at_.reset();
  descends_at_.reset();
  order(CommandKind::disarm);
  text(6, quirks_.disarmed_text);
}

// Take-off.

AckResult SimulatedAutopilot::take_off(double height_m) {
  const bool can = quirks_.dialect.own_takeoff && armed_ && !flying() && guided() &&
                   climb_ == Climb::none && height_m > 0;
  if (!can) return quirks_.refusal;
  climb_ = Climb::spooling;
  climb_at_ = now_;
  climb_height_ = height_m;
  return AckResult::accepted;
}

void SimulatedAutopilot::climb() {
  if (climb_ == Climb::spooling && since(climb_at_) >= quirks_.spool_s) {
    climb_ = Climb::climbing;
    climb_to_ = height() + climb_height_;
    landed_ = Landed::takeoff;
    order(CommandKind::takeoff, std::max(climb_height_, kLeastTakeoff));
    Eigen::Vector3d top = place_of(craft_);
    top.z() = climb_to_;
    guided_.hold(top, yaw_of(craft_));
  } else if (climb_ == Climb::climbing && height() > climb_to_ - kReached &&
             craft_.vehicle.mode != VehicleMode::takeoff) {
    climb_ = Climb::reached;
    reached_at_ = now_;
  } else if (climb_ == Climb::reached && since(reached_at_) >= quirks_.in_air_s) {
    climb_ = Climb::none;
    if (landed_ == Landed::takeoff) landed_ = Landed::in_air;
  }
}

/// The inner loops leave the ground by a take-off of their own; then setpoints lead.
void SimulatedAutopilot::climb_by_setpoints() {
  if (climb_ == Climb::none && !flying() && guided() && since(armed_at_) >= quirks_.spool_s &&
      guided_.wants_above(height() + kClimbWanted)) {
    climb_ = Climb::climbing;
    order(CommandKind::takeoff, kLeastTakeoff);
    climb_at_ = now_;
  } else if (climb_ == Climb::climbing && craft_.vehicle.mode == VehicleMode::takeoff) {
    if (since(climb_at_) >= quirks_.in_air_s) landed_ = Landed::in_air;
  } else if (climb_ == Climb::climbing && since(climb_at_) >= quirks_.in_air_s) {
    climb_ = Climb::none;
  }
}

// Landing.

void SimulatedAutopilot::follow_landing() {
  if (flying() && landing() && !touched_at_) landed_ = Landed::landing;
  if (descends_at_ && now_ >= *descends_at_) {
    order(CommandKind::land);
    descends_at_.reset();
  }
  const bool down = since(armed_at_) > kNotArmed && !craft_.vehicle.armed;
  if (down && !touched_at_) touched_at_ = now_;
  if (!touched_at_) {
    const bool idle = !flying() && climb_ == Climb::none;
    if (idle && since(armed_at_) >= quirks_.idle_disarm_s) disarm();
    return;
  }
  if (flying() && since(*touched_at_) >= quirks_.landed_s) landed_ = Landed::on_ground;
  if (!flying() && since(*touched_at_) >= quirks_.landed_s + quirks_.disarm_s) disarm();
}

// Setpoints.

void SimulatedAutopilot::hear(const SetPositionTargetLocalNed& target) {
  dead_ = dead_ || (quirks_.dies_of_nan && !is_finite(target));
  if (dead_ || (quirks_.dialect.own_takeoff && !guided())) return;
  if (quirks_.dialect.own_takeoff && !flying() && climb_ == Climb::none) return;
  if (!guided_.hear(target, now_)) return;
  if (quirks_.dialect.own_takeoff && climb_ != Climb::none) {
    ++cancelled_;
    climb_ = Climb::none;
  }
}

void SimulatedAutopilot::follow_setpoints() {
  const bool led = flying() && !landing() && !touched_at_ && climb_ != Climb::climbing;
  if (!led) return;
  Setpoint setpoint = guided_.setpoint(craft_, now_);
  setpoint.stamp += boot_;
  setpoint.expiry += boot_;
  orders_.setpoint = setpoint;
}

}  // namespace saker::tools
