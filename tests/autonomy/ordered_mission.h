#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "saker/autonomy/supervisor.h"

namespace saker::autonomy {

inline constexpr Time kOrderStep = kNanosecondsPerSecond / 50;

/// A mission with its ladder, given orders; the vehicle obeys at once, a pilot may take it.
class Orders : public testing::Test {
 protected:
  void run(double seconds) {
    for (const Time end = now + from_seconds(seconds); now < end; now += kOrderStep) step();
  }
  bool run_to(MissionPhase wanted, double seconds = 40) {
    for (const Time end = now + from_seconds(seconds); now < end; now += kOrderStep) {
      step();
      if (phase() == wanted) return true;
    }
    return false;
  }

  /// Given now; what became of it at the next step.
  OrderReply order(OrderKind kind) {
    given.push_back({++last_id, kind});
    step();
    return reply;
  }

  void step() {
    SupervisorInput input;
    input.now = now;
    const Time checker = checker_lives ? now : checker_died;
    input.heard = {now, now, now, checker, now, now, now, now};
    input.vehicle.stamp = now;
    input.vehicle.armed = armed;
    input.vehicle.mode = mode;
    input.vehicle.battery_share = battery;
    input.vehicle.faults = taken_over ? kTakenOver : 0U;
    input.odometry.stamp = now;
    input.odometry.status = VehicleOdometryStatus::ok;
    input.odometry.T_odom_body.translation() = Eigen::Vector3d(0, 0, height);
    input.acks = std::exchange(acks, {});
    input.odometry.velocity = Eigen::Vector3d(speed, 0, 0);
    input.planning = planning;
    input.planning.stamp = now;
    input.planning.column.state = TakeoffColumn::State::free;
    input.planning.landing = {ground, value, input.odometry.T_odom_body.translation()};
    input.has_targets = true;
    input.classified_share = 0.6;
    input.land_ordered = land_ordered;
    input.orders = std::exchange(given, {});
    const Mission::Output output = supervisor.step(std::move(input));
    orders = output.orders;
    anchors += output.anchor;
    if (output.reply) reply = *output.reply;
    for (const MissionEvent& event : output.events) events.push_back(event);
    if (output.command) obey(*output.command);
    fly();
  }

  void obey(const Command& command) {
    commands.push_back(command);
    if (!answers) return;
    const bool accepted = command.kind == CommandKind::resume ? gives_back : !taken_over;
    acks.push_back({now, command.id, accepted, accepted ? "" : "the pilot took over, mode 5"});
    if (!accepted) return;
    if (command.kind == CommandKind::arm) armed = true;
    if (command.kind == CommandKind::disarm) armed = false;
    if (command.kind == CommandKind::takeoff) mode = VehicleMode::takeoff;
    if (command.kind == CommandKind::land) mode = VehicleMode::land;
    if (command.kind == CommandKind::resume) taken_over = false, mode = VehicleMode::hold;
  }

  void fly() {
    if (orders.guidance != GuidanceOrder::silent && !taken_over && obeys_setpoints)
      mode = VehicleMode::guided;
    if (mode == VehicleMode::takeoff) height = std::min(3.0, height + 0.02);
    if (mode == VehicleMode::land) height = std::max(0.0, height - 0.02);
    if (mode == VehicleMode::land && height == 0) armed = false;
  }

  /// A pilot has it.
  void take_over() {
    taken_over = true;
    mode = VehicleMode::hold;
    run(0.1);
  }

  [[nodiscard]] MissionPhase phase() const { return supervisor.mission().phase(); }
  [[nodiscard]] Cause outcome() const { return supervisor.mission().outcome(); }
  [[nodiscard]] bool said(Cause cause) const {
    return std::any_of(events.begin(), events.end(),
                       [cause](const MissionEvent& e) { return e.cause == cause; });
  }
  [[nodiscard]] long sent(CommandKind kind) const {
    return std::count_if(commands.begin(), commands.end(),
                         [kind](const Command& c) { return c.kind == kind; });
  }
  void come_home() {
    planning.stamp = now;
    planning.order = PlanningOrder::tour;
    planning.status = PlanningStatus::tour_complete;
    ASSERT_TRUE(run_to(MissionPhase::return_home, 1));
    planning.order = PlanningOrder::home;
    planning.status = PlanningStatus::home_reached;
  }

  MissionConfig config;
  Supervisor supervisor{SafetyConfig{}, config, motion::Geofence(motion::GeofenceConfig{})};
  Time now = kNanosecondsPerSecond, checker_died = 0;
  bool armed = false, taken_over = false, checker_lives = true, land_ordered = false;
  bool gives_back = true, answers = true, obeys_setpoints = true;
  VehicleMode mode = VehicleMode::idle;
  double height = 0, battery = 0.9, speed = 0;
  Ground ground = Ground::fit;  // below it
  double value = NAN;           // of it
  std::int64_t last_id = 0;
  std::vector<Order> given;
  std::vector<CommandAck> acks;
  PlanningReport planning;
  MissionOrders orders;
  OrderReply reply;
  std::vector<MissionEvent> events;
  std::vector<Command> commands;
  int anchors = 0;
};

/// The same on its tour.
class InFlight : public Orders {
 protected:
  void SetUp() override { ASSERT_TRUE(run_to(MissionPhase::tour)); }

  void lands_for_good_by(OrderKind kind) {
    EXPECT_EQ(order(kind).state, OrderState::accepted);
    EXPECT_EQ(phase(), MissionPhase::landing);
    EXPECT_EQ(orders, MissionOrders{});
    for (const OrderKind up : {OrderKind::hold, OrderKind::resume, OrderKind::return_home}) {
      EXPECT_EQ(order(up).state, OrderState::refused);
      EXPECT_EQ(phase(), MissionPhase::landing);
    }
    ASSERT_TRUE(run_to(MissionPhase::done));
    EXPECT_EQ(outcome(), Cause::ordered);
    EXPECT_EQ(order(OrderKind::resume).state, OrderState::refused);
  }
};

inline constexpr MissionOrders kHolds = {GuidanceOrder::hold, PlanningOrder::none};
inline constexpr MissionOrders kSilent = {};

}  // namespace saker::autonomy
