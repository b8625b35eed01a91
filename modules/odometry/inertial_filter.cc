#include "saker/odometry/inertial_filter.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace saker::odometry {
namespace {

const Eigen::Vector3d kGravity(0, 0, -9.80665);  // m/s²

// Rows of the error state.
constexpr int kRotation = 0, kPlace = 3, kVelocity = 6, kRateBias = 9, kAccelerationBias = 12;

constexpr double kMostDoubt = 100;  // of variances: ten times the sd

Eigen::Matrix3d isotropic(double sd) { return sd * sd * Eigen::Matrix3d::Identity(); }

lidar::ImuSample between(const lidar::ImuSample& a, const lidar::ImuSample& b, Time stamp) {
  const double ratio =
      static_cast<double>(stamp - a.stamp) / static_cast<double>(b.stamp - a.stamp);
  lidar::ImuSample reading;
  reading.stamp = stamp;
  reading.acceleration = a.acceleration + ratio * (b.acceleration - a.acceleration);
  reading.angular_velocity = a.angular_velocity + ratio * (b.angular_velocity - a.angular_velocity);
  return reading;
}

}  // namespace

InertialFilter::InertialFilter(const InertialConfig& config) : config_(config) {
  covariance_.block<3, 3>(kRateBias, kRateBias) = isotropic(config.initial_rate_bias_rps);
  covariance_.block<3, 3>(kAccelerationBias, kAccelerationBias) =
      isotropic(config.initial_acceleration_bias_mps2);
}

void InertialFilter::start(Time stamp, const SE3& T_odom_lidar, const Matrix6d& covariance,
                           const Eigen::Vector3d& velocity, double velocity_sd) {
  reading_.stamp = stamp;
  has_reading_ = false;
  T_odom_lidar_ = T_odom_lidar;
  velocity_ = velocity;
  covariance_.topRows<9>().setZero();
  covariance_.leftCols<9>().setZero();
  covariance_.topLeftCorner<6, 6>() = covariance;
  covariance_.block<3, 3>(kVelocity, kVelocity) = isotropic(velocity_sd);
}

Eigen::Vector3d InertialFilter::rate() const {
  return has_reading_ ? Eigen::Vector3d(reading_.angular_velocity - rate_bias_)
                      : Eigen::Vector3d(Eigen::Vector3d::Zero());
}

Eigen::Vector3d InertialFilter::acceleration(const Eigen::Vector3d& force) const {
  return force - acceleration_bias_ + T_odom_lidar_.linear().transpose() * kGravity;
}

void InertialFilter::propagate(const lidar::ImuSample& sample) {
  const bool finite = sample.acceleration.allFinite() && sample.angular_velocity.allFinite();
  if (finite && sample.stamp > stamp()) advance(sample);
}

void InertialFilter::propagate(std::span<const lidar::ImuSample> imu, Time until) {
  for (const lidar::ImuSample& sample : imu) {
    if (sample.stamp > until && has_reading_ && sample.acceleration.allFinite() &&
        sample.angular_velocity.allFinite()) {
      return advance(between(reading_, sample, until));
    }
    if (sample.stamp <= until) propagate(sample);
  }
  coast(until);
}

void InertialFilter::coast(Time until) {
  if (until <= stamp()) return;
  lidar::ImuSample held = reading_;
  held.stamp = until;
  if (!has_reading_) held.acceleration = -(T_odom_lidar_.linear().transpose() * kGravity);
  if (!has_reading_) held.angular_velocity.setZero();
  advance(held);
}

void InertialFilter::advance(const lidar::ImuSample& next) {
  const double dt = to_seconds(next.stamp - stamp());
  const lidar::ImuSample& last = has_reading_ ? reading_ : next;
  const bool gap = dt > config_.max_gap_s;
  const Eigen::Vector3d rate = 0.5 * (last.angular_velocity + next.angular_velocity) - rate_bias_;
  const Eigen::Vector3d force = 0.5 * (last.acceleration + next.acceleration) - acceleration_bias_;
  const Eigen::Matrix3d turn = core::so3_exp(rate * dt);
  const Eigen::Matrix3d R = T_odom_lidar_.linear();
  const Eigen::Vector3d acceleration =
      gap ? Eigen::Vector3d(Eigen::Vector3d::Zero())
          : Eigen::Vector3d(R * core::so3_exp(rate * (dt / 2)) * force + kGravity);
  T_odom_lidar_.translation() += velocity_ * dt + acceleration * (dt * dt / 2);
  T_odom_lidar_.linear() =
      Eigen::Quaterniond(Eigen::Matrix3d(R * turn)).normalized().toRotationMatrix();
  velocity_ += acceleration * dt;
  grow(turn, force, dt, gap);
  reading_ = next;
  has_reading_ = true;
}

/// Solà 2017, eq. 269–271, all errors in the lidar frame.
void InertialFilter::grow(const Eigen::Matrix3d& turn, const Eigen::Vector3d& force, double dt,
                          bool gap) {
  const Eigen::Matrix3d back = turn.transpose();
  const Eigen::Matrix3d tilted = -back * core::hat(force);
  Matrix15d F = Matrix15d::Identity();
  F.block<3, 3>(kRotation, kRotation) = back;
  F.block<3, 3>(kRotation, kRateBias) = -dt * Eigen::Matrix3d::Identity();
  F.block<3, 3>(kPlace, kRotation) = 0.5 * dt * dt * tilted;
  F.block<3, 3>(kPlace, kPlace) = back;
  F.block<3, 3>(kPlace, kVelocity) = dt * back;
  F.block<3, 3>(kPlace, kAccelerationBias) = -0.5 * dt * dt * back;
  F.block<3, 3>(kVelocity, kRotation) = dt * tilted;
  F.block<3, 3>(kVelocity, kVelocity) = back;
  F.block<3, 3>(kVelocity, kAccelerationBias) = -dt * back;
  const Matrix15d carried = F * covariance_;
  covariance_.noalias() = carried * F.transpose();

  const double density = config_.acceleration_noise;
  const double velocity_variance =
      gap ? std::pow(config_.unknown_acceleration_mps2 * dt, 2) : density * density * dt;
  const double turn_variance = gap ? std::pow(config_.unknown_rate_rps * dt, 2)
                                   : config_.rate_noise * config_.rate_noise * dt;
  const auto add = [this](int row, int column, double variance) {
    covariance_.block<3, 3>(row, column).diagonal().array() += variance;
  };
  add(kRotation, kRotation, turn_variance);
  add(kPlace, kPlace, velocity_variance * dt * dt / 3);
  add(kPlace, kVelocity, velocity_variance * dt / 2);
  add(kVelocity, kPlace, velocity_variance * dt / 2);
  add(kVelocity, kVelocity, velocity_variance);
  add(kRateBias, kRateBias, config_.rate_bias_walk * config_.rate_bias_walk * dt);
  add(kAccelerationBias, kAccelerationBias,
      config_.acceleration_bias_walk * config_.acceleration_bias_walk * dt);
}

/// How the whole state follows its pose: P_xp P_pp⁻¹.
InertialFilter::Gain InertialFilter::gain() const {
  const Matrix6d pose = pose_covariance();
  return pose.ldlt().solve(covariance_.topRows<6>()).transpose();
}

Eigen::Vector3d InertialFilter::velocity_at(const SE3& T_odom_lidar) const {
  const Vector6d change = core::se3_log(T_odom_lidar_.inverse() * T_odom_lidar);
  return velocity_ + T_odom_lidar_.linear() * (gain().middleRows<3>(kVelocity) * change);
}

void InertialFilter::condition(const SE3& T_odom_lidar, const Matrix6d& covariance) {
  const Gain G = gain();
  const Eigen::Matrix<double, 15, 1> change =
      G * core::se3_log(T_odom_lidar_.inverse() * T_odom_lidar);
  velocity_ += T_odom_lidar_.linear() * change.segment<3>(kVelocity);
  rate_bias_ += change.segment<3>(kRateBias);
  acceleration_bias_ += change.segment<3>(kAccelerationBias);
  T_odom_lidar_ = T_odom_lidar;
  const Matrix15d sum = covariance_ + G * (covariance - pose_covariance()) * G.transpose();
  covariance_ = 0.5 * (sum + sum.transpose());
}

InertialFilter::Surprise InertialFilter::surprise(const SE3& T_odom_lidar,
                                                  const Matrix6d& noise) const {
  const Eigen::Matrix3d expected = (pose_covariance() + noise).bottomRightCorner<3, 3>();
  Surprise found;
  found.off = core::se3_log(T_odom_lidar_.inverse() * T_odom_lidar).tail<3>();
  found.square = found.off.dot(expected.ldlt().solve(found.off));
  return found;
}

/// Zhou and Frank 1996, their one factor: what was seen, less the measurement's error, by what the
/// state allows for.
void InertialFilter::doubt(const Surprise& surprise, const Matrix6d& noise) {
  const double seen = surprise.off.squaredNorm() - noise.bottomRightCorner<3, 3>().trace();
  const double allowed = pose_covariance().bottomRightCorner<3, 3>().trace();
  if (seen > allowed && allowed > 0) covariance_ *= std::min(seen / allowed, kMostDoubt);
}

void InertialFilter::correct(const SE3& T_odom_lidar, const Matrix6d& noise) {
  const Matrix6d prior = pose_covariance();
  const Matrix6d K = (prior + noise).ldlt().solve(prior).transpose();
  const Vector6d innovation = core::se3_log(T_odom_lidar_.inverse() * T_odom_lidar);
  condition(T_odom_lidar_ * core::se3_exp(K * innovation), prior - K * prior);
}

void InertialFilter::jump(const SE3& T_odom_lidar, const Matrix6d& covariance) {
  velocity_ = T_odom_lidar.linear() * (T_odom_lidar_.linear().transpose() * velocity_);
  T_odom_lidar_ = T_odom_lidar;
  fix_pose();
  covariance_.topLeftCorner<6, 6>() = covariance;
}

void InertialFilter::fix_pose() {
  covariance_.topRows<6>().setZero();
  covariance_.leftCols<6>().setZero();
}

}  // namespace saker::odometry
