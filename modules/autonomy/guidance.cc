#include "saker/autonomy/guidance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace saker::autonomy {
namespace {

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

motion::Trajectory resting(Time start, const motion::MotionState& state) {
  motion::Trajectory trajectory;
  trajectory.start = start;
  trajectory.step_s = 1;
  trajectory.states = {at_rest(state)};
  return trajectory;
}

motion::Trajectory spliced(const motion::Trajectory& first, const motion::Trajectory& second,
                           Time now) {
  const Time step = from_seconds(second.step_s);
  const Time lead = std::max<Time>(0, second.start - now);
  const Time steps = (lead + step - 1) / step;  // so that it begins at `now`, or just before
  motion::Trajectory result;
  result.step_s = second.step_s;
  result.start = second.start - steps * step;
  result.states.reserve(static_cast<std::size_t>(steps) + second.states.size());
  for (Time i = 0; i < steps; ++i) result.states.push_back(first.sample(result.start + i * step));
  result.states.insert(result.states.end(), second.states.begin(), second.states.end());
  return result;
}

Guidance::Guidance(const GuidanceConfig& config) : config_(core::checked(config, "guidance")) {}

void Guidance::replace(motion::Trajectory trajectory, Time now) {
  trajectory.id = ++last_id_;
  committed_ = std::make_shared<const motion::Trajectory>(std::move(trajectory));
  committed_at_ = now;
}

void Guidance::anchor(Time now, const VehicleOdometry& odometry) {
  motion::MotionState state;
  state.position = odometry.T_odom_body.translation();
  state.yaw = core::yaw(odometry.T_odom_body.linear());
  replace(resting(now, state), now);
  stopping_ = false;
}

CommitStatus Guidance::commit(const Proposal& proposal, Time now) {
  if (order_ != GuidanceOrder::follow || committed_ == nullptr) return CommitStatus::refused;
  if (proposal.from_id != committed_->id) return CommitStatus::other;
  if (proposal.trajectory.empty() || proposal.trajectory.start < now) return CommitStatus::late;
  replace(spliced(*committed_, proposal.trajectory, now), now);
  stopping_ = false;
  return CommitStatus::committed;
}

void Guidance::stop(Time now, std::string reason) {
  replace(motion::braked(*committed_, now, config_.braking), now);
  stopping_ = true;
  ++last_stop_.count;
  last_stop_.reason = std::move(reason);
}

std::optional<std::string> Guidance::reason_to_stop(
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
  return fmt::format("blocked at ({:.1f}, {:.1f}, {:.1f})", verdict->first_hit.x(),
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
    } else if (auto reason = reason_to_stop(now, verdict)) {
      stop(now, std::move(*reason));
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
