#include "tools/saker/faults/flight_watch.h"

#include <fmt/format.h>
#include <malloc.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>
#include <utility>

#include "saker/core/sha256.h"

namespace saker::tools {
namespace {

constexpr double kSettled_s = 2;
constexpr double kAtRest_mps = 0.3;  // in turbulence
constexpr double kFlewTowards_mps = 0.5;
constexpr std::size_t kMotions = 100;      // steps of a second
constexpr double kBlindDescent_mps = 0.8;  // over ground, blown by the wind
constexpr double kReaction_s = 0.6;  // a scan, a verdict, a step of guidance, and the vehicle's lag
constexpr double kHardGust_mps = 5;
constexpr double kBody_m = 0.5;        // radius and what an estimate of it may be wrong by
constexpr double kFenceSlack_m = 0.5;  // odometry, and the wind's push
constexpr double kSpan_s = 2;          // of a motion that odometry is held against
constexpr double kFarOff_sd = 5, kOff_sd = 3;
constexpr double kOffFor_s = 1;
constexpr double kMostGrowth_mb = 400;  // of all that a mission's ceilings allow
constexpr double kBegun_s = 15;         // the stages have what they need

bool comes_down(const VehicleState& state) {
  return !state.armed || state.mode == VehicleMode::land || state.mode == VehicleMode::descend;
}

bool is_mover(const Fault& fault) {
  return fault.kind == FaultKind::person || fault.kind == FaultKind::lorry;
}

double allocated_mb() {
  constexpr double kMegabyte = 1 << 20;
  const struct mallinfo2 heap = mallinfo2();
  return static_cast<double>(heap.uordblks + heap.hblkhd) / kMegabyte;
}

double largest_variance(const Matrix6d& covariance) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> of(covariance.bottomRightCorner<3, 3>(),
                                                          Eigen::EigenvaluesOnly);
  return of.eigenvalues().maxCoeff();
}

}  // namespace

const char* to_string(Invariant invariant) {
  constexpr std::array kNames = {"no_collision", "at_rest",        "in_fence",   "honest_odometry",
                                 "cause_said",   "bounded_memory", "whole_files"};
  return kNames[static_cast<std::size_t>(invariant)];
}

FlightWatch::FlightWatch(const FaultSchedule& schedule, const motion::GeofenceConfig& fence,
                         const motion::LimitsConfig& limits, Time begin)
    : schedule_(schedule), fence_(fence), limits_(limits), begin_(begin) {}

void FlightWatch::on_step(const simulation::VehicleTruth& truth, const VehicleState& state) {
  now_s_ = to_seconds(truth.stamp - begin_);
  truth_ = truth;
  std::array<double, 3> place{};
  Eigen::Map<Eigen::Vector3d>(place.data()) = truth.T_world_body.translation();
  path_.append(reinterpret_cast<const char*>(place.data()), sizeof place);
  if (state.mode != VehicleMode::descend)
    without_pose_s_ = NAN;
  else if (std::isnan(without_pose_s_))
    without_pose_s_ = now_s_;
  motions_.push_back(
      {now_s_, truth.T_world_body.translation().head<2>(), truth.velocity.head<2>()});
  if (motions_.size() > kMotions) motions_.pop_front();
  watch_movers();
  watch_collisions(truth, state);
  watch_rest(truth, state);
  watch_fence(truth, state);
  watch_memory();
}

void FlightWatch::broken(Invariant invariant, std::string text) {
  breaches_.try_emplace(invariant, Breach{invariant, now_s_, std::move(text)});
}

std::vector<Breach> FlightWatch::breaches() const {
  std::vector<Breach> list;
  for (const auto& [invariant, breach] : breaches_) list.push_back(breach);
  return list;
}

std::string FlightWatch::digest() const { return core::sha256(path_); }

void FlightWatch::watch_collisions(const simulation::VehicleTruth& truth,
                                   const VehicleState& state) {
  if (truth.collisions == collisions_) return;
  collisions_ = truth.collisions;
  struck_ = struck_ || struck();
  if (struck_ || unavoidable(truth, state)) return;
  const Eigen::Vector3d at = truth.T_world_body.translation();
  broken(Invariant::no_collision,
         fmt::format("at ({:.1f}, {:.1f}, {:.1f}) with {:.2f} m/s, mode {}, nearest {}", at.x(),
                     at.y(), at.z(), truth.velocity.norm(), saker::to_string(state.mode),
                     truth.nearest_label));
}

bool FlightWatch::unavoidable(const simulation::VehicleTruth& truth,
                              const VehicleState& state) const {
  const double speed = truth.velocity.head<2>().norm();
  if (came_into_the_way()) return true;
  const bool blind = state.mode == VehicleMode::descend ||
                     (aborted_ && (state.mode == VehicleMode::land || !state.armed));
  if (blind && speed < kBlindDescent_mps) return true;
  return blown();
}

void FlightWatch::watch_movers() {
  for (std::size_t i = 0; i < schedule_.size(); ++i)
    if (is_mover(schedule_[i]) && now_s_ >= schedule_[i].at_s)
      goals_.try_emplace(i, motions_.back().place);
}

/// It goes straight through its goal.
Eigen::Vector2d FlightWatch::place_of_mover(std::size_t fault, double t_s) const {
  const Fault& mover = schedule_[fault];
  const double towards = mover.towards_deg * std::numbers::pi / 180;
  const double gone_m = mover.strength * std::max(0.0, t_s - mover.at_s);
  return goals_.at(fault) +
         (gone_m - kMoverComesFrom_m) * Eigen::Vector2d(std::cos(towards), std::sin(towards));
}

/// By a person or a lorry that has not passed, and that the vehicle did not fly towards.
bool FlightWatch::struck() const {
  const Motion& before = motions_.front();
  return std::ranges::any_of(goals_, [&](const auto& goal) {
    const Fault& mover = schedule_[goal.first];
    const bool passed = now_s_ >= mover.at_s + 2 * kMoverComesFrom_m / mover.strength;
    const Eigen::Vector2d to_it = place_of_mover(goal.first, before.t_s) - before.place;
    return !passed && before.velocity.dot(to_it.normalized()) < kFlewTowards_mps;
  });
}

/// A wall that stood there too late to brake for it.
bool FlightWatch::came_into_the_way() const {
  const double fastest = limits_.max_speed;
  const double needed_m =
      kBody_m + fastest * kReaction_s + fastest * fastest / (2 * limits_.max_acceleration);
  const double stops_s = kReaction_s + fastest / limits_.max_acceleration;
  return std::ranges::any_of(schedule_, [&](const Fault& fault) {
    return fault.kind == FaultKind::wall && fault.strength < needed_m && now_s_ >= fault.at_s &&
           now_s_ < fault.at_s + stops_s;
  });
}

bool FlightWatch::blown() const {
  return std::ranges::any_of(schedule_, [&](const Fault& fault) {
    return fault.kind == FaultKind::gust && fault.strength > kHardGust_mps &&
           now_s_ >= fault.at_s && now_s_ < fault.at_s + fault.lasts_s + 1;
  });
}

void FlightWatch::on_event(const autonomy::MissionEvent& event) {
  using autonomy::MissionPhase;
  events_.push_back(event);
  if (event.from == event.to) return;
  const bool ends = event.to == MissionPhase::hold || event.to == MissionPhase::landing ||
                    event.to == MissionPhase::done;
  if (ends && (event.cause == autonomy::Cause::none || event.text.empty())) {
    broken(Invariant::cause_said, fmt::format("{} without a cause", to_string(event.to)));
  }
  if (event.to == MissionPhase::hold || event.to == MissionPhase::landing) {
    must_rest_s_ = to_seconds(event.stamp - begin_);
  }
}

void FlightWatch::refused(bool cause_known, const char* what) {
  if (!cause_known) broken(Invariant::cause_said, fmt::format("{} refused without a cause", what));
}

void FlightWatch::on_scan(const autonomy::IngestedScan& scan) {
  const bool registered = odometry::registered(scan.status);
  refused(registered || scan.reason != odometry::OdometryReason::none, "a scan");
}

void FlightWatch::on_plan(const autonomy::PlanningReport& report,
                          const active::ActivePlan& /*plan*/) {
  using enum autonomy::PlanningStatus;
  const bool no_way = report.status == refused || report.status == gave_up ||
                      report.status == nothing_reachable || report.status == home_unreachable;
  FlightWatch::refused(!no_way || !report.text.empty(), "a plan");
}

void FlightWatch::on_reply(const autonomy::OrderReply& reply) {
  const bool accepted = reply.state == autonomy::OrderState::accepted;
  aborted_ = aborted_ || (accepted && reply.order.kind == autonomy::OrderKind::abort);
  refused(reply.state != autonomy::OrderState::refused || !reply.text.empty(), "an order");
}

void FlightWatch::on_ack(const CommandAck& ack) {
  refused(ack.accepted || !ack.reason.empty(), "a command");
}

void FlightWatch::on_executive_gone(Time now) {
  if (truth_.airborne) must_rest_s_ = to_seconds(now - begin_);
}

void FlightWatch::on_torn_file(const std::string& what) { broken(Invariant::whole_files, what); }

void FlightWatch::watch_rest(const simulation::VehicleTruth& truth, const VehicleState& state) {
  if (std::isnan(must_rest_s_)) return;
  const bool gusty = std::ranges::any_of(schedule_, [&](const Fault& fault) {
    return fault.kind == FaultKind::gust && now_s_ >= fault.at_s &&
           now_s_ < fault.at_s + fault.lasts_s + kSettled_s;
  });
  if (!truth.airborne || truth.velocity.norm() < kAtRest_mps || comes_down(state) || gusty) {
    must_rest_s_ = NAN;
  } else if (now_s_ > must_rest_s_ + kSettled_s) {
    broken(Invariant::at_rest, fmt::format("{:.2f} m/s {:g} s after hold or landing was said",
                                           truth.velocity.norm(), kSettled_s));
    must_rest_s_ = NAN;
  }
}

void FlightWatch::watch_fence(const simulation::VehicleTruth& truth, const VehicleState& state) {
  if (!truth.airborne || state.mode == VehicleMode::descend || blown()) return;
  const double inside_m = fence_.inside_polygon_m(truth.T_world_body.translation().head<2>());
  const double speed = truth.velocity.head<2>().norm();
  const double braking_m =
      kFenceSlack_m + speed * kReaction_s + speed * speed / (2 * limits_.max_acceleration);
  if (inside_m < -braking_m) {
    broken(Invariant::in_fence, fmt::format("{:.2f} m outside with {:.2f} m/s", -inside_m, speed));
  }
}

void FlightWatch::on_odometry(const VehicleOdometry& odometry) {
  if (!truth_.airborne || odometry.stamp < truth_.stamp) return;  // stays where its samples end
  const double t_s = to_seconds(odometry.stamp - begin_);
  const bool good = odometry.status == VehicleOdometryStatus::ok;
  poses_.push_back({t_s, truth_.T_world_body.translation(), odometry.T_odom_body.translation(),
                    largest_variance(odometry.covariance), odometry.reset_counter, good});
  const auto recent =
      std::ranges::find_if(poses_, [&](const Pose& pose) { return pose.t_s >= t_s - kSpan_s; });
  poses_.erase(poses_.begin(), recent);
  const Pose &first = poses_.front(), &last = poses_.back();
  if (!first.good || !last.good || first.resets != last.resets) {
    off_since_s_ = NAN;
    return;
  }
  const double off_m = ((last.said - first.said) - (last.truth - first.truth)).norm();
  const double off_sd = off_m / std::sqrt(first.variance + last.variance);
  if (!(off_sd > kOff_sd)) {
    off_since_s_ = NAN;
    return;
  }
  if (std::isnan(off_since_s_)) off_since_s_ = t_s;
  if (off_sd > kFarOff_sd || t_s - off_since_s_ > kOffFor_s) {
    broken(Invariant::honest_odometry,
           fmt::format("status ok, a motion of {:g} s off by {:.2f} m, {:.1f} sd", kSpan_s, off_m,
                       off_sd));
  }
}

void FlightWatch::watch_memory() {
  const bool whole_second = std::fmod(now_s_, 1.0) < 0.005;
  if (!whole_second || now_s_ < kBegun_s) return;
  const double now_mb = allocated_mb();
  if (std::isnan(memory_mb_)) memory_mb_ = now_mb;
  if (now_mb > memory_mb_ + kMostGrowth_mb) {
    broken(Invariant::bounded_memory,
           fmt::format("{:.0f} MB more than at {:g} s", now_mb - memory_mb_, kBegun_s));
  }
}

}  // namespace saker::tools
