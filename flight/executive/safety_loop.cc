#include "flight/executive/safety_loop.h"

#include <utility>

#include "flight/bus/messages.h"

namespace saker::flight {
namespace {

constexpr Time kRepeat = kNanosecondsPerSecond / 5;  // of the last resort's command
// As mission.landing_s: a landing that was agreed to and is not over by then is begun again.
constexpr Time kLongestLanding = 60 * kNanosecondsPerSecond;

}  // namespace

SafetyLoop::SafetyLoop(SafetyParts parts, Blackboard& board, Bus& bus)
    : parts_(std::move(parts)), board_(board), bus_(bus) {}

LoopStatus SafetyLoop::run() {
  const Time now = board_.clock.now();
  if (lands_alone_) {
    land_alone(now);
  } else {
    try {
      obey(parts_.step(seen(now)), now);
      throws_ = 0;
    } catch (...) {
      lands_alone_ = ++throws_ >= kMostThrows;
      throw;
    }
  }
  const auto vehicle = board_.vehicle.latest();
  return {vehicle ? 1e3 * to_seconds(now - vehicle->stamp) : NAN, board_.acks.dropped()};
}

autonomy::SupervisorInput SafetyLoop::seen(Time now) {
  autonomy::SupervisorInput input;
  input.now = now;
  if (const auto vehicle = board_.vehicle.latest()) {
    input.vehicle = *vehicle;
    input.heard.vehicle = vehicle->stamp;
  }
  if (const auto odometry = board_.odometry.latest()) input.odometry = *odometry;
  if (const auto map = board_.map_news.latest()) {
    input.T_world_odom = map->T_world_odom;
    input.heard.mapping = map->stamp;
    input.classified_share = map->classified_share;
  }
  if (const auto verdict = board_.verdict.latest()) input.heard.verdict = verdict->stamp;
  if (const auto report = board_.report.latest()) {
    input.planning = *report;
    input.heard.planning = report->stamp;
  }
  if (const auto contact = board_.contact.latest()) input.contact = *contact;
  input.setpoint = board_.setpoint.latest();
  if (const auto stop = board_.stop.latest()) input.stop = *stop;
  input.heard.occupancy = board_.newest_grid;
  input.heard.lidar = board_.newest_scan;
  input.heard.odometry = board_.newest_registered;
  input.heard.guidance = board_.guided;
  input.marked = board_.marked;
  while (auto ack = board_.acks.pop()) input.acks.push_back(std::move(*ack));
  input.has_targets = parts_.has_targets;
  input.land_ordered = parts_.land_ordered();
  if (board_.operator_orders.size() > 0) input.orders = board_.operator_orders.take_all();
  return input;
}

void SafetyLoop::obey(const autonomy::Mission::Output& output, Time now) {
  if (output.command) {
    last_command_ = output.command->id;
    bus_.publish(to_lcm(*output.command));
  }
  anchors_ += output.anchor;
  board_.orders.put({output.orders, anchors_, now});
  if (output.reply) board_.order_reply.put(*output.reply);
  for (const autonomy::MissionEvent& event : output.events) board_.events.push(event);
  board_.mission_done = parts_.mission_done();
}

/// A flight controller answers an id that it knows from memory and does nothing: after a refusal
/// the next command is another one.
void SafetyLoop::land_alone(Time now) {
  board_.orders.put({autonomy::MissionOrders{}, anchors_, now});
  while (const auto ack = board_.acks.pop()) {
    if (ack->id == last_command_ && anew_ == kNever)
      anew_ = ack->accepted ? now + kLongestLanding : now;
  }
  const auto vehicle = board_.vehicle.latest();
  if (vehicle && !vehicle->armed) {
    board_.mission_done = true;
  } else if (now - commanded_ >= kRepeat) {
    if (commanded_ == 0 || now >= anew_) {
      ++last_command_;
      anew_ = kNever;
    }
    commanded_ = now;
    bus_.publish(to_lcm(Command{.stamp = now, .id = last_command_, .kind = CommandKind::land}));
  }
}

}  // namespace saker::flight
