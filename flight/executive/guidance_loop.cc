#include "flight/executive/guidance_loop.h"

#include "flight/bus/messages.h"

namespace saker::flight {

using autonomy::GuidanceOrder;

namespace {

constexpr Time kOrdersLive = kNanosecondsPerSecond / 2;  // 25 runs of safety

GuidanceOrder obeyed(const Orders& orders, Time now) {
  const GuidanceOrder order = orders.orders.guidance;
  const bool fresh = now - orders.stamp <= kOrdersLive;
  return fresh || order == GuidanceOrder::silent ? order : GuidanceOrder::hold;
}

}  // namespace

GuidanceLoop::GuidanceLoop(const autonomy::GuidanceConfig& config, Blackboard& board, Bus& bus)
    : setpoints_live_(from_seconds(config.setpoint_expiry_s)),
      board_(board),
      bus_(bus),
      guidance_(config) {}

LoopStatus GuidanceLoop::run() {
  const Time now = board_.clock.now();
  const Orders orders = board_.orders.latest().value_or(Orders{});
  begin_anew(orders, now);
  take_proposal(now);
  const std::optional<motion::Verdict> verdict = board_.verdict.latest();
  const auto setpoint = guidance_.update(now, obeyed(orders, now), verdict);
  if (guidance_.committed() != shown_) {
    shown_ = guidance_.committed();
    board_.committed.put(shown_);
  }
  board_.stop.put(guidance_.last_stop());
  publish(setpoint);
  sent_ = setpoint ? now : 0;
  board_.guided = now;
  return {verdict ? 1e3 * to_seconds(now - verdict->stamp) : NAN, 0};
}

/// Where it was told to, or after a pause.
void GuidanceLoop::begin_anew(const Orders& orders, Time now) {
  const bool paused = sent_ != 0 && now - sent_ > setpoints_live_;
  if (orders.anchors == anchors_seen_ && !paused) return;
  const auto odometry = board_.odometry.latest();
  if (!odometry) return;
  anchors_seen_ = orders.anchors;
  guidance_.anchor(now, *odometry);
}

/// The one before is freed by planning, which keeps it until its next run.
void GuidanceLoop::take_proposal(Time now) {
  auto plan = board_.plan.latest();
  if (plan == last_plan_) return;
  last_plan_ = std::move(plan);
  if (last_plan_->proposal) (void)guidance_.commit(*last_plan_->proposal, now);  // else once more
}

void GuidanceLoop::publish(const std::optional<Setpoint>& setpoint) {
  if (!setpoint) return board_.setpoint.clear();
  bus_.publish(to_lcm(*setpoint));
  board_.setpoint.put(*setpoint);
}

}  // namespace saker::flight
