#include <utility>

#include "flight/bus/messages.h"
#include "flight/executive/executive.h"

/// The loops from the map to setpoints.
namespace saker::flight {

using autonomy::PlanningOrder;

namespace {

constexpr std::size_t kMostViewpoints = 10000;  // of a flight: some tens

}  // namespace

LoopStatus Executive::pose() {
  const Time now = board_.clock.now();
  for (const lidar::ImuSample& sample : board_.imu.take_all()) {
    body_pose_.add(sample, now);
    contact_.add(sample);
  }
  board_.contact.put(contact_.last());
  for (const PoseFix& fix : board_.pose_fixes.take_all()) {
    body_pose_.correct(fix.stamp, fix.T_odom_lidar, fix.covariance);
  }
  VehicleOdometry odometry = body_pose_.at(now);
  bus_.publish(to_lcm(odometry));
  board_.odometry.put(odometry);
  send_trajectory(board_.clock.now());
  return {age_ms(board_.newest_registered), board_.imu.dropped() + board_.pose_fixes.dropped()};
}

LoopStatus Executive::plan() {
  autonomy::PlanningInput input;
  input.now = board_.clock.now();
  if (const auto orders = board_.orders.latest()) input.order = orders->orders.planning;
  if (const auto odometry = board_.odometry.latest()) input.odometry = *odometry;
  input.map = board_.map.latest();
  input.grid = board_.grid.latest();
  input.committed = board_.committed.latest();
  input.verdict = board_.verdict.latest();
  const autonomy::PlanningConfig& config = config_.autonomy.planning;
  const auto deadline =
      core::Budget::Clock::now() + std::chrono::duration_cast<core::Budget::Clock::duration>(
                                       std::chrono::duration<double>(config.budget_s));
  autonomy::Planning::Output output = timings_.ordinary.time("planning", [&] {
    return planning_.step(input, core::Budget::until(deadline, config.iterations));
  });
  if (input.order == PlanningOrder::tour) publish_plan(output);
  if (const auto& goal = output.plan.goal;
      goal && viewpoints_.size() < kMostViewpoints &&
      (viewpoints_.empty() || viewpoints_.back().second.id != goal->id)) {
    viewpoints_.emplace_back(output.report.stamp, *goal);
  }
  board_.report.put(output.report);
  // The last one lives on until the next run: guidance is never the one that frees it.
  plan_before_ = std::exchange(
      newest_plan_, std::make_shared<const autonomy::Planning::Output>(std::move(output)));
  board_.plan.put(newest_plan_);
  return {age_ms(input.map ? input.map->stamp : 0), 0};
}

/// Whenever another one is flown. Here and not in guidance, which must not wait for memory.
void Executive::send_trajectory(Time now) {
  const auto committed = board_.committed.latest();
  if (committed == nullptr || committed->id == sent_trajectory_) return;
  if (const auto message = to_lcm(*committed, now)) bus_.publish(*message);
  sent_trajectory_ = committed->id;
}

}  // namespace saker::flight
