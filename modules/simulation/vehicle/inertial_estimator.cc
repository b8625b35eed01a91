#include "saker/simulation/vehicle/inertial_estimator.h"

#include <algorithm>
#include <cmath>

#include "saker/simulation/vehicle/quadrotor.h"

namespace saker::simulation {
namespace {

constexpr double kFirstLevelling = 0.05;  ///< s

}  // namespace

InertialEstimator::InertialEstimator(const InertialEstimatorConfig& config)
    : config_(core::checked(config, "inertial")) {}

void InertialEstimator::propagate_attitude(const lidar::ImuSample& sample, double dt) {
  const double force = sample.acceleration.norm();
  const bool trusted = std::abs(force / kStandardGravity - 1) < config_.trusted_g;
  if (!has_up_ && trusted) {
    R_ = Eigen::Quaterniond::FromTwoVectors(sample.acceleration, Eigen::Vector3d::UnitZ());
    has_up_ = true;
  }
  Eigen::Vector3d correction = Eigen::Vector3d::Zero();
  if (trusted) {
    levelled_s_ += dt;  // at first all readings count alike
    const double time = std::clamp(levelled_s_, kFirstLevelling, config_.attitude_time_s);
    const Eigen::Vector3d up = R_.row(2);
    correction = (sample.acceleration / force).cross(up) / time;
  }
  gyro_bias_ -= dt / config_.bias_time_s * correction;
  angular_velocity_ = sample.angular_velocity - gyro_bias_;
  R_ = R_ * core::so3_exp(dt * (angular_velocity_ + correction));
  R_ = Eigen::Quaterniond(R_).normalized().toRotationMatrix();
}

void InertialEstimator::propagate(const lidar::ImuSample& sample, double dt) {
  propagate_attitude(sample, dt);
  if (!has_height_) return;
  const double upwards = R_.row(2).dot(sample.acceleration) - kStandardGravity - climb_bias_;
  height_ += dt * climb_rate_ + 0.5 * dt * dt * upwards;
  climb_rate_ += dt * upwards;
}

/// Three poles at −1 / height_time_s.
void InertialEstimator::correct_height(double barometer_m, double dt) {
  if (!has_height_) height_ = barometer_m;
  has_height_ = true;
  const double error = barometer_m - height_;
  const double k = 1 / config_.height_time_s;
  height_ += dt * 3 * k * error;
  climb_rate_ += dt * 3 * k * k * error;
  climb_bias_ -= dt * k * k * k * error;
}

}  // namespace saker::simulation
