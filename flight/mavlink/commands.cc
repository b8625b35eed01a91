#include "flight/mavlink/commands.h"

#include <algorithm>
#include <array>
#include <utility>

namespace saker::flight::mavlink {
namespace {

constexpr int kWarning = 4;               // MAV_SEVERITY: what is greater is no cause
constexpr std::size_t kMostReason = 200;  // of an answer's text
constexpr std::size_t kMostDone = 16;
constexpr Time kTextAge = kNanosecondsPerSecond / 2;  // before a refusal, of its cause

/// Causes that go away by themselves on an aircraft that has just booted, or by what we send.
constexpr std::array kPassing = {
    "inconsistent",        "waiting for home",  "Need Alt Estimate",    "not calibrated",
    "EKF attitude is bad", "Gyros not healthy", "VisOdom: not healthy", "Need Position Estimate"};

bool passes(const std::string& text) {
  return std::any_of(kPassing.begin(), kPassing.end(),
                     [&](const char* cause) { return text.find(cause) != std::string::npos; });
}

const char* words_of(AckResult result) {
  switch (result) {
    case AckResult::accepted:
      return "accepted";
    case AckResult::temporarily_rejected:
      return "rejected for now";
    case AckResult::denied:
      return "denied";
    case AckResult::unsupported:
      return "not supported";
    case AckResult::failed:
      return "failed";
    case AckResult::in_progress:
      return "in progress";
    case AckResult::cancelled:
      return "cancelled";
  }
  return "an unknown result";
}

}  // namespace

Step mode_step(const ModeNumber& mode) {
  return {kDoSetMode, {float{kCustomModeFlag}, mode.main, mode.sub}};
}

std::vector<Step> steps_of(const Command& command, const Dialect& dialect) {
  switch (command.kind) {
    case CommandKind::arm:
      return {mode_step(dialect.hold), {kArmDisarm, {1}}};
    case CommandKind::disarm:
      return {{kArmDisarm, {0}}};
    case CommandKind::takeoff:
      if (!dialect.own_takeoff) return {mode_step(dialect.guided)};
      return {{kNavTakeoff, {0, 0, 0, 0, 0, 0, static_cast<float>(command.height_m)}}};
    case CommandKind::hold:
    case CommandKind::resume:  // to where it stands; setpoints that come move it
      return {mode_step(dialect.hold)};
    case CommandKind::land:
      return {mode_step(dialect.land)};
  }
  return {};
}

void Commander::begin(std::int64_t id, std::vector<Step> steps, Time now) {
  if (order_ && order_->id == id) return;
  if (last_ && last_->id == id) {
    if (done_.size() < kMostDone) done_.push_back(*last_);
    return;
  }
  if (order_) finish(false, "overtaken by another order");
  Order order;
  order.id = id;
  order.steps = std::move(steps);
  order.began = order.next_send = now;
  order_ = std::move(order);
  if (order_->steps.empty()) finish(true, "");
}

std::optional<Step> Commander::current() const {
  if (!order_) return std::nullopt;
  return order_->steps[order_->at];
}

std::optional<CommandLong> Commander::due(Time now) {
  settle(now);
  if (!order_ || order_->refused || now < order_->next_send) return std::nullopt;
  if (order_->tries == config_.most_tries) {
    finish(false, "the autopilot does not answer");
    return std::nullopt;
  }
  const Step& step = order_->steps[order_->at];
  CommandLong message;
  message.command = step.command;
  message.confirmation = static_cast<std::uint8_t>(order_->tries++);
  const auto& p = step.parameters;
  message.param1 = p[0];
  message.param2 = p[1];
  message.param3 = p[2];
  message.param4 = p[3];
  message.param5 = p[4];
  message.param6 = p[5];
  message.param7 = p[6];
  order_->next_send = now + from_seconds(config_.answer_s);
  return message;
}

bool Commander::hear(const CommandAck& ack, Time now) {
  if (!order_ || order_->refused || ack.command != order_->steps[order_->at].command ||
      order_->tries == 0)
    return false;
  switch (static_cast<AckResult>(ack.result)) {
    case AckResult::accepted:
      order_->tries = 0;
      order_->next_send = now;
      if (++order_->at == order_->steps.size()) finish(true, "");
      return true;
    case AckResult::in_progress:
      order_->tries = 1;
      order_->next_send = now + from_seconds(config_.again_s);
      return true;
    case AckResult::temporarily_rejected:
    case AckResult::denied:
    case AckResult::unsupported:
    case AckResult::failed:
    case AckResult::cancelled:
      order_->refused = static_cast<AckResult>(ack.result);
      order_->refused_at = now;
      return true;
  }
  return false;
}

void Commander::hear_text(int severity, const std::string& text, Time now) {
  if (severity > kWarning || text.empty()) return;
  const bool joins = !text_.empty() && now - text_at_ < from_seconds(config_.cause_s) &&
                     text_.find(text) == std::string::npos;
  text_ = joins ? text_ + "; " + text : text;
  text_.resize(std::min(text_.size(), kMostReason));
  text_at_ = now;
}

/// A refusal whose cause had time to come: tried again where it may pass, else the end.
void Commander::settle(Time now) {
  if (!order_ || !order_->refused || now - order_->refused_at < from_seconds(config_.cause_s))
    return;
  const std::string why = cause(*order_->refused);
  const bool again = *order_->refused == AckResult::temporarily_rejected ||
                     (*order_->refused == AckResult::failed && passes(why));
  if (!again || now - order_->began > from_seconds(config_.patience_s)) return finish(false, why);
  order_->next_send = order_->refused_at + from_seconds(config_.again_s);
  order_->refused.reset();
  order_->tries = 0;
}

std::string Commander::cause(AckResult result) const {
  const bool told = !text_.empty() && text_at_ + kTextAge >= order_->refused_at;
  return told ? text_ : words_of(result);
}

void Commander::finish(bool accepted, const std::string& reason) {
  last_ = saker::CommandAck{0, order_->id, accepted, reason};
  if (done_.size() < kMostDone) done_.push_back(*last_);
  order_.reset();
}

std::vector<saker::CommandAck> Commander::take_done(Time now) {
  settle(now);
  return std::exchange(done_, {});
}

}  // namespace saker::flight::mavlink
