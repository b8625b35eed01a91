#include "saker/autonomy/guidance.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

namespace saker::autonomy {
namespace {

constexpr std::size_t kMostStates = 4096;  // as many as TRAJECTORY takes: 200 s at 20 Hz

motion::MotionState at_rest(motion::MotionState state) {
  state.velocity.setZero();
  state.acceleration.setZero();
  state.yaw_rate = 0;
  return state;
}

}  // namespace

const char* to_string(GuidanceOrder order) {
  constexpr const char* kNames[] = {"silent", "hold", "follow"};
  return kNames[static_cast<int>(order)];
}

const char* to_string(CommitStatus status) {
  constexpr const char* kNames[] = {"committed", "late", "begins on what is no longer flown",
                                    "guidance does not follow"};
  return kNames[static_cast<int>(status)];
}

motion::Trajectory resting(Time start, const motion::MotionState& state,
                           std::vector<motion::MotionState> memory) {
  motion::Trajectory trajectory;
  trajectory.start = start;
  trajectory.step_s = 1;
  trajectory.states = std::move(memory);
  trajectory.states.assign(1, at_rest(state));
  return trajectory;
}

motion::Trajectory spliced(const motion::Trajectory& first, const motion::Trajectory& second,
                           Time now, std::vector<motion::MotionState> memory) {
  const Time step = from_seconds(second.step_s);
  const Time lead = std::max<Time>(0, second.start - now);
  const Time steps = (lead + step - 1) / step;  // so that it begins at `now`, or just before
  motion::Trajectory result;
  result.step_s = second.step_s;
  result.start = second.start - steps * step;
  memory.clear();
  result.states = std::move(memory);
  result.states.reserve(static_cast<std::size_t>(steps) + second.states.size());
  for (Time i = 0; i < steps; ++i) result.states.push_back(first.sample(result.start + i * step));
  result.states.insert(result.states.end(), second.states.begin(), second.states.end());
  return result;
}

Guidance::Guidance(const GuidanceConfig& config) : config_(core::checked(config, "guidance")) {
  for (auto& trajectory : memory_) {
    trajectory = std::make_shared<motion::Trajectory>();
    trajectory->states.reserve(kMostStates);
  }
}

std::shared_ptr<motion::Trajectory> Guidance::unused() const {
  for (const auto& trajectory : memory_) {
    if (trajectory.use_count() != 1) continue;
    std::atomic_thread_fence(std::memory_order_acquire);  // after the last reader let go of it
    return trajectory;
  }
  return std::make_shared<motion::Trajectory>();  // others hold that many
}

void Guidance::replace(std::shared_ptr<motion::Trajectory> trajectory, Time now) {
  trajectory->id = ++last_id_;
  committed_ = std::move(trajectory);
  committed_at_ = now;
}

void Guidance::anchor(Time now, const VehicleOdometry& odometry) {
  motion::MotionState state;
  state.position = odometry.T_odom_body.translation();
  state.yaw = core::yaw(odometry.T_odom_body.linear());
  auto trajectory = unused();
  *trajectory = resting(now, state, std::move(trajectory->states));
  replace(std::move(trajectory), now);
  stopping_ = false;
}

CommitStatus Guidance::commit(const Proposal& proposal, Time now) {
  if (order_ != GuidanceOrder::follow || committed_ == nullptr) return CommitStatus::refused;
  if (proposal.from_id != committed_->id) return CommitStatus::other;
  if (proposal.trajectory.empty() || proposal.trajectory.start < now) return CommitStatus::late;
  auto trajectory = unused();
  *trajectory = spliced(*committed_, proposal.trajectory, now, std::move(trajectory->states));
  replace(std::move(trajectory), now);
  stopping_ = false;
  return CommitStatus::committed;
}

void Guidance::stop(Time now, const core::Text& reason) {
  auto trajectory = unused();
  *trajectory = motion::braked(*committed_, now, config_.braking, std::move(trajectory->states));
  replace(std::move(trajectory), now);
  stopping_ = true;
  ++last_stop_.count;
  last_stop_.reason = reason;
}

std::optional<core::Text> Guidance::reason_to_stop(
    Time now, const std::optional<motion::Verdict>& verdict) const {
  const Time silence = from_seconds(config_.verdict_silence_s);
  if (!verdict || now - std::max(verdict->stamp, Time{0}) > silence) return "no verdict";
  if (verdict->trajectory_id != committed_->id) {
    if (now - committed_at_ > silence) return "no verdict on this trajectory";
    return std::nullopt;  // the checker has not met it yet
  }
  if (verdict->clear) return std::nullopt;
  const Time rest = motion::stands_at(*committed_, now, config_.braking);
  if (rest + from_seconds(config_.stop_margin_s) < verdict->clear_until) return std::nullopt;
  return core::text("blocked at ({:.1f}, {:.1f}, {:.1f})", verdict->first_hit.x(),
                    verdict->first_hit.y(), verdict->first_hit.z());
}

std::optional<Setpoint> Guidance::update(Time now, GuidanceOrder order,
                                         const std::optional<motion::Verdict>& verdict) {
  const bool told_to_hold = order == GuidanceOrder::hold && order_ != GuidanceOrder::hold;
  order_ = order;
  if (order == GuidanceOrder::silent || committed_ == nullptr) return std::nullopt;
  const bool moving = now < committed_->end();
  if (moving && !stopping_) {
    if (told_to_hold || order == GuidanceOrder::hold) {
      stop(now, "told to hold");
    } else if (const auto reason = reason_to_stop(now, verdict)) {
      stop(now, *reason);
    }
  }
  const motion::MotionState state = committed_->sample(now);
  Setpoint setpoint;
  setpoint.stamp = now;
  setpoint.expiry = now + from_seconds(config_.setpoint_expiry_s);
  setpoint.position = state.position;
  setpoint.velocity = state.velocity;
  setpoint.acceleration = state.acceleration;
  setpoint.yaw = state.yaw;
  setpoint.yaw_rate = state.yaw_rate;
  return setpoint;
}

}  // namespace saker::autonomy
