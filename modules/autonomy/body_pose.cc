#include "autonomy/body_pose.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/error.h"

namespace saker::autonomy {
namespace {

constexpr double kRadians = std::numbers::pi / 180;
constexpr double kGravity = 9.80665;        // m/s²
constexpr std::size_t kMostSamples = 4000;  // 2 s at 2 kHz
constexpr double kLongestStep_s = 0.1;      // a longer gap between samples is no motion known
constexpr double kLongestAhead_s = 0.05;    // of the newest sample; then it is taken to stay
constexpr double kLongestInterval_s = 1.0;  // between scans that teach biases
const Eigen::Vector3d kGravityVector(0, 0, -kGravity);

SE3 pose_of(const Eigen::Matrix3d& R, const Eigen::Vector3d& t) {
  SE3 T = SE3::Identity();
  T.linear() = R;
  T.translation() = t;
  return T;
}

}  // namespace

BodyPose::BodyPose(const BodyPoseConfig& config, const SE3& T_body_lidar)
    : config_(core::checked(config, "body_pose")), T_body_lidar_(T_body_lidar) {}

void BodyPose::add(const lidar::ImuSample& sample) {
  if (!sample.acceleration.allFinite() || !sample.angular_velocity.allFinite()) return;
  if (!samples_.empty() && sample.stamp <= samples_.back().stamp) return;
  samples_.push_back(sample);
  if (samples_.size() > kMostSamples) samples_.pop_front();
  if (started_ && sample.stamp > newest_.stamp) newest_ = moved(newest_, sample);
}

BodyPose::State BodyPose::moved(State state, const lidar::ImuSample& sample) const {
  const double dt = std::min(to_seconds(sample.stamp - state.stamp), kLongestStep_s);
  state.rate = sample.angular_velocity - gyro_bias_;
  const Eigen::Matrix3d R_middle = state.R_odom_lidar * core::so3_exp(state.rate * (dt / 2));
  const Eigen::Vector3d acceleration =
      R_middle * (sample.acceleration - acceleration_bias_) + kGravityVector;
  state.R_odom_lidar *= core::so3_exp(state.rate * dt);
  state.position += state.velocity * dt + acceleration * (dt * dt / 2);
  state.velocity += acceleration * dt;
  state.stamp = sample.stamp;
  return state;
}

/// From the last registered scan to `stamp`.
BodyPose::State BodyPose::propagated(Time stamp) const {
  State state = scan_;
  for (const lidar::ImuSample& sample : samples_) {
    if (sample.stamp <= state.stamp) continue;
    if (sample.stamp >= stamp) {  // the sample's interval, up to the stamp
      lidar::ImuSample last = sample;
      last.stamp = stamp;
      return moved(state, last);
    }
    state = moved(state, sample);
  }
  const double dt = to_seconds(stamp - state.stamp);
  state.position += state.velocity * dt;
  state.R_odom_lidar *= core::so3_exp(state.rate * dt);
  state.stamp = stamp;
  return state;
}

void BodyPose::correct(Time stamp, const SE3& T_odom_lidar) {
  if (started_ && stamp <= scan_.stamp) return;
  if (!T_odom_lidar.matrix().allFinite()) return;
  if (!started_) {
    begin(stamp, T_odom_lidar);
  } else {
    const State predicted = propagated(stamp);
    if (jumped(predicted, T_odom_lidar)) {
      ++reset_counter_;
      begin(stamp, T_odom_lidar);
    } else {
      learn(predicted, stamp, T_odom_lidar);
    }
  }
  while (!samples_.empty() && samples_.front().stamp <= stamp) samples_.pop_front();
  newest_ = scan_;
  for (const lidar::ImuSample& sample : samples_) newest_ = moved(newest_, sample);
}

void BodyPose::begin(Time stamp, const SE3& T_odom_lidar) {
  started_ = true;
  scan_ = {};
  scan_.stamp = stamp;
  scan_.R_odom_lidar = T_odom_lidar.linear();
  scan_.position = T_odom_lidar.translation();
}

bool BodyPose::jumped(const State& predicted, const SE3& measured) const {
  const Eigen::Matrix3d turn = predicted.R_odom_lidar.transpose() * measured.linear();
  return (measured.translation() - predicted.position).norm() > config_.jump_m ||
         core::so3_log(turn).norm() > config_.jump_deg * kRadians;
}

/// Fading-memory filters, Brookner eq. 1.2-33 (degree 2) and 1.2-26 (degree 1), θ = memory.
void BodyPose::learn(const State& predicted, Time stamp, const SE3& measured) {
  const double dt = std::min(to_seconds(stamp - scan_.stamp), kLongestInterval_s);
  const double m = config_.memory;
  const Eigen::Vector3d error = measured.translation() - predicted.position;
  const Eigen::Vector3d turn =
      core::so3_log(predicted.R_odom_lidar.transpose() * measured.linear());

  scan_ = predicted;
  scan_.position += (1 - m * m * m) * error;
  scan_.velocity += 1.5 * (1 - m) * (1 - m) * (1 + m) / dt * error;
  acceleration_bias_ -= std::pow(1 - m, 3) / (dt * dt) * (measured.linear().transpose() * error);
  scan_.R_odom_lidar *= core::so3_exp((1 - m * m) * turn);
  gyro_bias_ -= (1 - m) * (1 - m) / dt * turn;
}

VehicleOdometry BodyPose::at(Time now) const {
  VehicleOdometry result;
  result.stamp = now;
  result.reset_counter = reset_counter_;
  if (!started_) return result;
  // A pose that stays must not claim to be of now: who flies by it would take it for a lie.
  result.stamp = std::min(now, newest_.stamp + from_seconds(kLongestAhead_s));
  const double silent = to_seconds(now - newest_.stamp);
  const double ahead = std::min(silent, kLongestAhead_s);
  const double age = to_seconds(now - scan_.stamp);
  const SE3 T_odom_lidar = pose_of(newest_.R_odom_lidar * core::so3_exp(newest_.rate * ahead),
                                   newest_.position + newest_.velocity * ahead);
  const SE3 T_lidar_body = T_body_lidar_.inverse();
  result.T_odom_body = T_odom_lidar * T_lidar_body;
  result.velocity =
      newest_.velocity + T_odom_lidar.linear() * newest_.rate.cross(T_lidar_body.translation());
  result.angular_velocity = T_body_lidar_.linear() * newest_.rate;
  const double sd_turn = config_.sd_rotation_deg * kRadians;
  const double sd_place = config_.sd_position_m + config_.sd_acceleration_mps2 * age * age / 2;
  result.covariance = Matrix6d::Zero();
  result.covariance.diagonal().head<3>().setConstant(sd_turn * sd_turn);
  result.covariance.diagonal().tail<3>().setConstant(sd_place * sd_place);
  const bool fresh = age <= config_.fresh_s && silent <= kLongestAhead_s;
  result.status = fresh                   ? VehicleOdometryStatus::ok
                  : age <= config_.lost_s ? VehicleOdometryStatus::predicted
                                          : VehicleOdometryStatus::lost;
  return result;
}

}  // namespace saker::autonomy
