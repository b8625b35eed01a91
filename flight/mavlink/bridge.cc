#include "flight/mavlink/bridge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "saker/core/config.h"
#include "saker/core/se3.h"

namespace saker::flight::mavlink {
namespace {

constexpr std::size_t kMostFrames = 64, kMostDirect = 16;
constexpr std::uint8_t kOnboardComputer = 18, kNoAutopilot = 8, kActive = 4, kVersion = 3;
constexpr std::uint8_t kAutopilotComponent = 1;

}  // namespace

bool Bridge::Timer::due(Time now) {
  if (now < next) return false;
  next = now - next > period ? now + period : next + period;
  return true;
}

bool Bridge::Timer::early(Time now) {
  if (now < next - 19 * period / 20) return false;  // 11 ms after the last at 50 Hz
  next = now + 3 * period / 2;
  return true;
}

Bridge::Bridge(const BridgeConfig& config, const std::optional<SigningKey>& key)
    : config_(core::checked(config, "mavlink")),
      dialect_(dialect_of(config.autopilot)),
      mounting_(config.place_m, config.rotation_deg),
      signing_(key ? std::optional<Signing>{{*key, 0, {}}} : std::nullopt),
      reader_(signing_ ? &*signing_ : nullptr),
      writer_(static_cast<std::uint8_t>(config.system),
              static_cast<std::uint8_t>(config.component)),
      state_(dialect_, static_cast<std::uint8_t>(config.autopilot_system)) {
  frames_.reserve(kMostFrames);
}

template <class Message>
void Bridge::send(const Message& message) {
  if (frames_.size() == kMostFrames) {
    ++counters_.overflow;
    return;
  }
  auto frame = writer_.write(message, signing_ ? &*signing_ : nullptr, signing_now_);
  if (frame)
    frames_.push_back(*frame);
  else
    ++counters_.not_finite;
}

void Bridge::hear_bytes(std::span<const std::uint8_t> bytes, Time now, SigningTime signing_now) {
  while (!bytes.empty()) {
    bytes = bytes.subspan(reader_.push(bytes));
    read(now, signing_now);
  }
}

void Bridge::settle(Time now, SigningTime signing_now) {
  reader_.settle();
  read(now, signing_now);
}

void Bridge::read(Time now, SigningTime signing_now) {
  signing_now_ = signing_now;
  while (const auto frame = reader_.next(signing_now)) hear(*frame, now);
}

void Bridge::hear(const Frame& frame, Time now) {
  (void)state_.hear(frame, now);
  if (state_.system() != 0 && frame.system == state_.system() &&
      frame.component == kAutopilotComponent)
    hear_autopilot(frame, now);
}

void Bridge::hear_autopilot(const Frame& frame, Time now) {
  const auto for_us = [&](std::uint8_t system, std::uint8_t component) {
    return (system == 0 || system == config_.system) &&
           (component == 0 || component == config_.component);
  };
  switch (frame.id) {
    case Heartbeat::kId: {
      const AutopilotState& s = state_.state();
      authority_.hear(s.armed, s.custom_mode, s.system_status, now);
      return;
    }
    case RcChannels::kId:
      authority_.hear(decode<RcChannels>(frame.bytes()));
      return;
    case CommandAck::kId: {
      const auto ack = decode<CommandAck>(frame.bytes());
      if (for_us(ack.target_system, ack.target_component)) commander_.hear(ack, now);
      return;
    }
    case Statustext::kId: {
      const auto message = decode<Statustext>(frame.bytes());
      commander_.hear_text(message.severity, text_of(message.text), now);
      return;
    }
    case Timesync::kId: {
      const auto message = decode<Timesync>(frame.bytes());
      if (!for_us(message.target_system, message.target_component)) return;
      if (const auto answer = TimeSync::answer(message, now)) {
        time_sync_.count_answered();
        return send(*answer);
      }
      const int restarts = time_sync_.restarts();
      time_sync_.hear(message, now);
      if (time_sync_.restarts() != restarts) state_.forget_origin();
      return;
    }
    default:
      return;
  }
}

void Bridge::hear(const VehicleOdometry& odometry, Time now, bool fresh) {
  const OdometryOut::Result result = odometry_.hear(mounting_.odometry(odometry), now, fresh);
  if (!state_.connected(now)) return;
  if (result.message) {
    send(*result.message);
    ++counters_.odometry;
  }
  if (!result.reset) return;
  // In the same tick: else the autopilot flies the jump back.
  setpoints_.follow(*result.reset, sensor_time(now));
  if (may_move(now)) {
    setpoint_.next = now;
    send_setpoint(now);
  }
  if (!dialect_.resets_yaw && std::abs(result.reset->yaw) > config_.most_reset_yaw && flying())
    land(now, "the heading of odometry was reset");
}

void Bridge::hear(const Setpoint& setpoint, Time now) {
  setpoint_heard_ |= setpoints_.hear(mounting_.setpoint(setpoint), sensor_time(now));
}

void Bridge::hear(const Command& command, Time now) {
  const auto refuse = [&](const std::string& why) {
    if (direct_answers_.size() < kMostDirect)
      direct_answers_.push_back({0, command.id, false, why});
  };
  if (!state_.connected(now))
    return refuse(state_.refusal().empty() ? "no autopilot is heard" : state_.refusal());
  const bool resumes = command.kind == CommandKind::resume;
  if (!resumes) resumed_ = 0;
  if (!authority_.ours() && !resumes) return refuse(authority_.cause());
  if (command.id <= 0) return refuse("an order's id is 1 or more");
  const bool takeoff = command.kind == CommandKind::takeoff;
  if (takeoff && !(command.height_m > 0 && command.height_m < 1000))
    return refuse("a take-off needs a height");
  if (command.kind != CommandKind::land && command.kind != CommandKind::disarm &&
      !odometry_.good(now))
    return refuse("there is no odometry");
  if (command.kind == CommandKind::hold) setpoints_.stop(here());
  if (command.kind == CommandKind::land) setpoints_.clear();
  if (takeoff && !dialect_.own_takeoff) {
    if (takeoff_answer_ && takeoff_answer_->id == command.id) {
      if (direct_answers_.size() < kMostDirect) direct_answers_.push_back(*takeoff_answer_);
      return;
    }
    if (!takeoff_ || takeoff_->id != command.id) {
      takeoff_ = command;
      takeoff_begun_ = false;
      setpoints_.stop(here());
      stream_since_ = now;
    }
    return;
  }
  takeoff_.reset();
  takeoff_answer_.reset();
  // Said once more after it was obeyed, it takes nothing from who took over meanwhile.
  resume_ = resumes && command.id != resumed_ ? command.id : 0;
  commander_.begin(command.id, steps_of(command, dialect_), now);
}

void Bridge::step(Time now, SigningTime signing_now) {
  signing_now_ = signing_now;
  if (heartbeat_.due(now)) {
    Heartbeat message;
    message.type = kOnboardComputer;
    message.autopilot = kNoAutopilot;
    message.system_status = kActive;
    message.mavlink_version = kVersion;
    send(message);
  }
  if (!state_.connected(now)) return;
  if (const auto question = time_sync_.question(now)) send(*question);
  if (ask_.due(now)) ask_for_messages();
  if (!state_.state().has_origin && origin_.due(now)) {
    SetGpsGlobalOrigin message;
    message.latitude = static_cast<std::int32_t>(std::lround(config_.latitude_deg * 1e7));
    message.longitude = static_cast<std::int32_t>(std::lround(config_.longitude_deg * 1e7));
    message.altitude = static_cast<std::int32_t>(std::lround(config_.altitude_m * 1e3));
    message.target_system = state_.system();
    message.time_usec = static_cast<std::uint64_t>(now / 1000);
    send(message);
  }
  watch(now);
  if ((setpoint_heard_ && setpoint_.early(now)) || setpoint_.due(now)) {
    setpoint_heard_ = false;
    send_setpoint(now);
  }
  send_orders(now);
}

/// Again and again: an autopilot that rebooted has forgotten it.
void Bridge::ask_for_messages() {
  for (const Wanted& wanted : wanted_messages(dialect_)) {
    CommandLong message;
    message.command = kSetMessageInterval;
    message.param1 = static_cast<float>(wanted.id);
    message.param2 = static_cast<float>(1e6 / wanted.rate_hz);
    message.target_system = state_.system();
    message.target_component = kAutopilotComponent;
    send(message);
  }
}

void Bridge::send_orders(Time now) {
  auto message = commander_.due(now);
  if (!message) return;
  const std::optional<Step> step = commander_.current();
  for (const ModeNumber& mode : {dialect_.guided, dialect_.hold, dialect_.land})
    if (step && step->command == kDoSetMode && step->parameters[1] == mode.main &&
        step->parameters[2] == mode.sub)
      authority_.asked(mode.custom, now);
  message->target_system = state_.system();
  message->target_component = kAutopilotComponent;
  send(*message);
  ++counters_.commands;
}

void Bridge::send_setpoint(Time now) {
  if (!may_move(now)) return;
  send([&] {
    auto message = setpoints_.tick(here(), sensor_time(now), now);
    message.target_system = state_.system();
    message.target_component = kAutopilotComponent;
    return message;
  }());
  ++counters_.setpoints;
}

/// What has to be answered at once, and what the mode has to become.
void Bridge::watch(Time now) {
  if (!state_.state().armed || state_.state().landed == Landed::on_ground) {
    if (!takeoff_ && !streams_before_guided()) setpoints_.clear();
  }
  if (!authority_.ours()) {
    setpoints_.clear();
    takeoff_.reset();
    stream_since_.reset();
    cause_ = authority_.cause();
    return;
  }
  if (flying() && !odometry_.good(now) && state_.state().custom_mode != dialect_.land.custom) {
    land(now, "odometry is lost");
    return;
  }
  // Setpoints that come while the vehicle holds: the executive goes on.
  const bool holds = flying() && !guided() && state_.state().custom_mode == dialect_.hold.custom;
  if (holds && setpoints_.fresh(sensor_time(now)) && !commander_.busy()) {
    if (!stream_since_) stream_since_ = now;
    if (now - *stream_since_ >= dialect_.stream_before_guided) begin_own(dialect_.guided, now);
  } else if (!takeoff_ && guided()) {
    stream_since_.reset();
  }
  if (takeoff_ && !takeoff_begun_ && stream_since_ &&
      now - *stream_since_ >= dialect_.stream_before_guided) {
    takeoff_begun_ = true;
    commander_.begin(takeoff_->id, steps_of(*takeoff_, dialect_), now);
  }
}

void Bridge::land(Time now, const std::string& cause) {
  setpoints_.clear();
  takeoff_.reset();
  stream_since_.reset();
  counters_.losses += cause_ != cause;
  cause_ = cause;
  begin_own(dialect_.land, now);
}

/// An order that nobody gave, unless it runs. HEARTBEAT may show its mode a second late.
void Bridge::begin_own(const ModeNumber& mode, Time now) {
  const std::optional<Step> step = commander_.current();
  const Step wanted = mode_step(mode);
  const bool runs =
      step && step->command == wanted.command && step->parameters == wanted.parameters;
  const bool new_mode = own_mode_ != mode.custom;
  if (runs || (!new_mode && now < own_again_)) return;
  own_mode_ = mode.custom;
  own_again_ = now + kNanosecondsPerSecond;
  commander_.begin(--own_id_, {wanted}, now);
}

std::vector<saker::CommandAck> Bridge::take_answers(Time now) {
  std::vector<saker::CommandAck> answers = std::exchange(direct_answers_, {});
  for (saker::CommandAck& answer : commander_.take_done(now)) {
    if (takeoff_ && answer.id == takeoff_->id) finish_takeoff(answer, now);
    if (answer.accepted && answer.id == resume_) give_back();
    if (answer.id > 0) answers.push_back(std::move(answer));
  }
  return answers;
}

/// The autopilot holds, as an operator ordered: the executive flies again.
void Bridge::give_back() {
  authority_.give_back();
  cause_.clear();
  resumed_ = std::exchange(resume_, 0);
}

/// PX4 is in offboard mode: up, by setpoints.
void Bridge::finish_takeoff(const saker::CommandAck& answer, Time now) {
  if (answer.accepted)
    setpoints_.climb(here(), takeoff_->height_m, now);
  else
    stream_since_.reset();
  takeoff_answer_ = answer;
  takeoff_.reset();
}

bool Bridge::flying() const {
  return state_.state().armed && state_.state().landed != Landed::on_ground &&
         state_.state().landed != Landed::unknown;
}

bool Bridge::guided() const { return state_.state().custom_mode == dialect_.guided.custom; }

bool Bridge::streams_before_guided() const {
  return !dialect_.own_takeoff && (stream_since_.has_value() || setpoints_.climbing());
}

/// Setpoints would cancel ArduPilot's take-off: not before it is in the air.
bool Bridge::may_move(Time now) const {
  const AutopilotState& s = state_.state();
  if (!authority_.ours() || !state_.connected(now) || !s.armed || !odometry_.good(now))
    return false;
  if (streams_before_guided()) return true;
  const bool in_air = s.landed == Landed::in_air || (!dialect_.own_takeoff && flying());
  return guided() && in_air;
}

Place Bridge::here() const {
  if (!odometry_.newest()) return {};
  const SE3& T = odometry_.newest()->T_odom_body;
  return {T.translation(), core::yaw(T.rotation())};
}

Time Bridge::sensor_time(Time now) const { return odometry_.clock().sensor(now).value_or(0); }

VehicleMode Bridge::mode(Time now) const {
  const AutopilotState& s = state_.state();
  if (!s.armed) return VehicleMode::idle;
  if (s.custom_mode == dialect_.land.custom || s.landed == Landed::landing)
    return odometry_.good(now) ? VehicleMode::land : VehicleMode::descend;
  if (!authority_.ours()) return VehicleMode::hold;
  if (s.landed == Landed::takeoff || takeoff_ || setpoints_.climbing()) return VehicleMode::takeoff;
  if (s.landed == Landed::on_ground) return VehicleMode::idle;
  return guided() && !setpoints_.stopped() ? VehicleMode::guided : VehicleMode::hold;
}

std::optional<VehicleState> Bridge::vehicle_state(Time now) const {
  if (!state_.connected(now)) return std::nullopt;
  const AutopilotState& s = state_.state();
  VehicleState state;
  state.stamp = sensor_time(now);
  state.armed = s.armed;
  state.mode = mode(now);
  state.attitude = mounting_.attitude(s.attitude);
  state.height_m = state_.height_m();
  state.battery_share = s.battery_share;
  if (!authority_.ours()) state.faults |= kTakenOver;
  if (!odometry_.good(now)) state.faults |= kNoOdometry;
  if (s.estimator_flags && !state_.estimator_good()) state.faults |= kOdometryRejected;
  if (setpoints_.stopped()) state.faults |= kSetpointExpired;
  if (s.battery_share < config_.battery_low) state.faults |= kBatteryLow;
  return state;
}

}  // namespace saker::flight::mavlink
