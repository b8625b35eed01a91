#include "flight/bus/messages.h"
#include "flight/executive/executive.h"

/// The loops from the map to setpoints.
namespace saker::flight {

using autonomy::CommitStatus;
using autonomy::PlanningOrder;

namespace {

constexpr std::size_t kMostViewpoints = 10000;  // of a flight: some tens

}  // namespace

LoopStatus Executive::pose() {
  for (const lidar::ImuSample& sample : board_.imu.take_all()) {
    body_pose_.add(sample);
    if (contact_.add(sample)) board_.contact = sample.stamp;
  }
  for (const PoseFix& fix : board_.pose_fixes.take_all()) {
    body_pose_.correct(fix.stamp, fix.T_odom_lidar, fix.covariance);
  }
  VehicleOdometry odometry = body_pose_.at(board_.clock.now());
  bus_.publish(to_lcm(odometry));
  board_.odometry.put(odometry);
  return {age_ms(board_.newest_registered), board_.imu.dropped() + board_.pose_fixes.dropped()};
}

LoopStatus Executive::plan() {
  autonomy::PlanningInput input;
  input.now = board_.clock.now();
  input.order = board_.orders.latest()->orders.planning;
  if (const auto odometry = board_.odometry.latest()) input.odometry = *odometry;
  input.map = board_.map.latest();
  input.grid = board_.grid.latest();
  input.committed = board_.committed.latest();
  if (const auto verdict = board_.verdict.latest()) input.verdict = *verdict;
  const autonomy::PlanningConfig& config = config_.autonomy.planning;
  const auto deadline =
      core::Budget::Clock::now() + std::chrono::duration_cast<core::Budget::Clock::duration>(
                                       std::chrono::duration<double>(config.budget_s));
  autonomy::Planning::Output output = timings_.time("planning", [&] {
    return planning_.step(input, core::Budget::until(deadline, config.iterations));
  });
  if (input.order == PlanningOrder::tour) publish_plan(output);
  if (const auto& goal = output.plan.goal;
      goal && viewpoints_.size() < kMostViewpoints &&
      (viewpoints_.empty() || viewpoints_.back().second.id != goal->id)) {
    viewpoints_.emplace_back(output.report.stamp, *goal);
  }
  board_.plan.put(std::move(output));
  return {age_ms(input.map ? input.map->stamp : 0), 0};
}

void Executive::begin_anew() {
  const auto odometry = board_.odometry.latest();
  const int anchors = board_.orders.latest()->anchors;
  if (anchors == anchors_seen_ || odometry == nullptr) return;
  anchors_seen_ = anchors;
  guidance_.anchor(board_.clock.now(), *odometry);
}

void Executive::take_proposal(Time now) {
  const auto plan = board_.plan.latest();
  if (plan == last_plan_) return;
  last_plan_ = plan;
  if (plan->proposal) (void)guidance_.commit(*plan->proposal, now);  // else it is planned again
}

LoopStatus Executive::guide() {
  const Time now = board_.clock.now();
  begin_anew();
  take_proposal(now);
  std::optional<motion::Verdict> verdict;
  if (const auto newest = board_.verdict.latest()) verdict = *newest;
  const auto setpoint = guidance_.update(now, board_.orders.latest()->orders.guidance, verdict);
  send_trajectory(now);
  board_.stop.put(guidance_.last_stop());
  if (setpoint) {
    bus_.publish(to_lcm(*setpoint));
    board_.setpoint.put(*setpoint);
  } else if (board_.setpoint.latest() != nullptr) {
    board_.setpoint.put(std::shared_ptr<const Setpoint>());
  }
  return {age_ms(verdict ? verdict->stamp : 0), 0};
}

/// Whenever another one is flown.
void Executive::send_trajectory(Time now) {
  const auto& committed = guidance_.committed();
  if (committed == nullptr || committed->id == sent_trajectory_) return;
  sent_trajectory_ = committed->id;
  board_.committed.put(committed);
  if (const auto message = to_lcm(*committed, now)) bus_.publish(*message);
}

autonomy::SupervisorInput Executive::seen(Time now) {
  autonomy::SupervisorInput input;
  input.now = now;
  if (const auto vehicle = board_.vehicle.latest()) {
    input.vehicle = *vehicle;
    input.heard.vehicle = vehicle->stamp;
  }
  if (const auto odometry = board_.odometry.latest()) input.odometry = *odometry;
  if (const auto map = board_.map.latest()) {
    input.T_world_odom = map->T_world_odom;
    input.heard.mapping = map->stamp;
    input.classified_share = map->classified_share;
  }
  if (const auto verdict = board_.verdict.latest()) input.heard.verdict = verdict->stamp;
  if (const auto grid = board_.grid.latest()) input.heard.occupancy = grid->stamp;
  if (const auto plan = board_.plan.latest()) {
    input.planning = plan->report;
    input.heard.planning = plan->report.stamp;
  }
  if (const auto setpoint = board_.setpoint.latest()) input.setpoint = *setpoint;
  if (const auto stop = board_.stop.latest()) input.stop = *stop;
  input.heard.lidar = board_.newest_scan;
  input.heard.odometry = board_.newest_registered;
  input.acks = board_.acks.take_all();
  input.has_targets = has_targets_;
  input.land_ordered = board_.land_ordered;
  input.contact = board_.contact;
  input.grid = board_.grid.latest();
  return input;
}

LoopStatus Executive::supervise() {
  const auto output = supervisor_.step(seen(board_.clock.now()));
  if (output.command) bus_.publish(to_lcm(*output.command));
  anchors_ += output.anchor;
  board_.orders.put(Orders{output.orders, anchors_});
  for (const autonomy::MissionEvent& event : output.events) board_.events.push(event);
  board_.mission_done = supervisor_.mission().done();
  const auto vehicle = board_.vehicle.latest();
  return {age_ms(vehicle ? vehicle->stamp : 0), board_.acks.dropped()};
}

}  // namespace saker::flight
