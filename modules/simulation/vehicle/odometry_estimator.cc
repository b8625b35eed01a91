#include "saker/simulation/vehicle/odometry_estimator.h"

#include <algorithm>
#include <numbers>

#include "saker/simulation/vehicle/quadrotor.h"

namespace saker::simulation {
namespace {

constexpr double kMostInterval = 0.05;         ///< s between two odometries that counts as a whole
constexpr double kMostGyroBias = 0.05;         ///< rad/s: more is a fault, not a bias
constexpr double kMostAccelerationBias = 0.3;  ///< m/s²

Eigen::Vector3d clamped(const Eigen::Vector3d& v, double most) {
  return v.cwiseMax(-most).cwiseMin(most);
}

}  // namespace

OdometryEstimator::OdometryEstimator(const OdometryEstimatorConfig& config)
    : config_(core::checked(config, "odometry_estimator")) {}

Eigen::Vector3d OdometryEstimator::angular_velocity() const {
  return last_sample_.angular_velocity - now_.gyro_bias;
}

void OdometryEstimator::advance(State& s, const lidar::ImuSample& sample, double dt) const {
  s.R = s.R * core::so3_exp(dt * (sample.angular_velocity - s.gyro_bias));
  const Eigen::Vector3d gravity(0, 0, -kStandardGravity);
  const Eigen::Vector3d seen = s.R * sample.acceleration + gravity;
  const Eigen::Vector3d acceleration = seen - s.R * s.acceleration_bias;
  s.position += dt * s.velocity + 0.5 * dt * dt * acceleration;
  s.velocity += dt * acceleration;
  s.seen_velocity += dt * seen;
}

void OdometryEstimator::propagate(const lidar::ImuSample& sample, double dt) {
  last_sample_ = sample;
  advance(now_, sample, dt);
  now_.R = Eigen::Quaterniond(now_.R).normalized().toRotationMatrix();
  past_.push_back({sample, dt, now_});
  const Time kept = from_seconds(std::max(config_.most_latency_s, config_.take_back_s));
  while (sample.stamp - past_.front().sample.stamp > kept) past_.pop_front();
}

/// The newest one that is not after `stamp`, else the first.
std::size_t OdometryEstimator::entry_at(Time stamp) const {
  const auto after =
      std::upper_bound(past_.begin(), past_.end(), stamp,
                       [](Time t, const Entry& entry) { return t < entry.sample.stamp; });
  return after == past_.begin() ? 0 : static_cast<std::size_t>(after - past_.begin()) - 1;
}

void OdometryEstimator::replay_after(std::size_t entry) {
  now_ = past_[entry].after;
  for (std::size_t i = entry + 1; i < past_.size(); ++i) {
    advance(now_, past_[i].sample, past_[i].dt);
    past_[i].after = now_;
  }
}

void OdometryEstimator::restart(const VehicleOdometry& odometry) {
  if (past_.empty()) return;
  const std::size_t entry = entry_at(odometry.stamp);
  State& then = past_[entry].after;
  then.R = odometry.T_odom_body.linear();
  then.position = odometry.T_odom_body.translation();
  then.velocity = odometry.velocity;
  replay_after(entry);
  last_odometry_ = odometry;
  seen_at_last_ = then.seen_velocity;
  velocity_drift_.setZero();
  position_drift_.setZero();
  started_ = true;
  past_.erase(past_.begin(), past_.begin() + static_cast<std::ptrdiff_t>(entry));  // another odom
}

/// Every state is corrected by odometry up to its own time only: the oldest one knows none of it.
void OdometryEstimator::take_back() {
  if (!past_.empty()) replay_after(0);
}

/// Leaky sums of what the accelerometer did not see and of what its own velocity does not explain.
void OdometryEstimator::watch_drift(const VehicleOdometry& odometry, const State& then) {
  const double dt = to_seconds(odometry.stamp - last_odometry_.stamp);
  const double kept = std::exp(-dt / config_.drift_time_s);
  const Eigen::Vector3d said = odometry.velocity - last_odometry_.velocity;
  velocity_drift_ = kept * velocity_drift_ + said - (then.seen_velocity - seen_at_last_);
  const Eigen::Vector3d moved =
      odometry.T_odom_body.translation() - last_odometry_.T_odom_body.translation();
  position_drift_ =
      kept * position_drift_ + moved - 0.5 * dt * (odometry.velocity + last_odometry_.velocity);
  last_odometry_ = odometry;
  seen_at_last_ = then.seen_velocity;
}

OdometryDoubt OdometryEstimator::doubt(const VehicleOdometry& odometry, const State& then) const {
  const auto far = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b, double gate) {
    return !((a - b).norm() <= gate);  // NaN is far
  };
  const double gate = config_.attitude_gate_deg * std::numbers::pi / 180;
  const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
  const Eigen::Matrix3d turned = then.R.transpose() * odometry.T_odom_body.linear();
  if (far(core::so3_log(turned), zero, gate)) return "attitude contradicts the gyroscope";
  if (far(odometry.velocity, then.velocity, config_.velocity_gate_mps))
    return "velocity contradicts the accelerometer";
  if (far(odometry.T_odom_body.translation(), then.position, config_.position_gate_m))
    return "position jumps";
  if (far(velocity_drift_, zero, config_.velocity_drift_gate_mps))
    return "velocity drifts from the accelerometer";
  if (far(position_drift_, zero, config_.position_drift_gate_m))
    return "position drifts from its velocity";
  return nullptr;
}

OdometryDoubt OdometryEstimator::correct(const VehicleOdometry& odometry) {
  if (past_.empty() || !started_) return "no inertial readings yet";
  if (!odometry.T_odom_body.matrix().allFinite() || !odometry.velocity.allFinite())
    return "not finite";
  const std::size_t entry = entry_at(odometry.stamp);
  State& then = past_[entry].after;
  const double dt = std::min(kMostInterval, to_seconds(odometry.stamp - last_odometry_.stamp));
  watch_drift(odometry, then);
  if (OdometryDoubt reason = doubt(odometry, then)) return reason;
  const Eigen::Vector3d turn = core::so3_log(then.R.transpose() * odometry.T_odom_body.linear());
  const Eigen::Vector3d speed = odometry.velocity - then.velocity;
  const double rate = dt / config_.bias_time_s;
  then.gyro_bias = clamped(then.gyro_bias - rate / config_.attitude_time_s * turn, kMostGyroBias);
  then.acceleration_bias = clamped(
      then.acceleration_bias - rate / config_.velocity_time_s * (then.R.transpose() * speed),
      kMostAccelerationBias);
  then.R = then.R * core::so3_exp(std::min(1.0, dt / config_.attitude_time_s) * turn);
  then.velocity += std::min(1.0, dt / config_.velocity_time_s) * speed;
  then.position += std::min(1.0, dt / config_.position_time_s) *
                   (odometry.T_odom_body.translation() - then.position);
  replay_after(entry);
  return nullptr;
}

}  // namespace saker::simulation
