#include "saker/active/tour/target_state.h"

#include <algorithm>

namespace saker::active {

using Phase = TargetState::Phase;

Phase TargetState::fly_to(const Viewpoint& viewpoint, const Eigen::Vector3d& vehicle) {
  if (ended()) return phase_;
  if (++goals_ > limits_.most_goals) return give_up();
  goal_ = viewpoint;
  closest_m_ = (vehicle - viewpoint.position).norm();
  idle_s_ = standing_s_ = dwell_s_ = 0;
  return phase_ = Phase::approaching;
}

Phase TargetState::update(const Eigen::Vector3d& vehicle, double elapsed_s, bool stands) {
  if (phase_ != Phase::approaching) return phase_;
  const double distance = (vehicle - goal_->position).norm();
  idle_s_ += elapsed_s;
  standing_s_ = stands ? standing_s_ + elapsed_s : 0;
  if (distance < limits_.arrived_m) dwell_s_ += elapsed_s;
  if (distance < closest_m_ - limits_.progress_m) {
    closest_m_ = distance;
    idle_s_ = 0;
  }
  if (dwell_s_ > limits_.dwell_s) {
    goal_.reset();
    return phase_ = Phase::reached;
  }
  const bool stalled = idle_s_ > limits_.patience_s || standing_s_ > limits_.standing_s;
  return stalled ? refuse() : phase_;
}

void TargetState::see_new() { goals_ = 0, idle_s_ = 0, standing_s_ = 0; }

Phase TargetState::refuse() {
  if (phase_ != Phase::approaching) return phase_;
  given_up_.push_back(goal_->position);
  goal_.reset();
  phase_ = Phase::waiting;
  return static_cast<int>(given_up_.size()) >= limits_.most_refusals ? give_up() : phase_;
}

Phase TargetState::give_up() {
  if (ended()) return phase_;
  goal_.reset();
  given_up_.clear();
  goals_ = 0;
  return phase_ = ++attempts_ >= limits_.attempts ? Phase::exhausted : Phase::put_off;
}

void TargetState::leave() {
  goal_.reset();
  if (phase_ == Phase::approaching) phase_ = Phase::waiting;
}

bool TargetState::gave_up(const Eigen::Vector3d& place) const {
  return std::ranges::any_of(given_up_, [&](const Eigen::Vector3d& given_up) {
    return (given_up - place).norm() < limits_.refused_m;
  });
}

}  // namespace saker::active
