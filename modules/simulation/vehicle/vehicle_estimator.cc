#include "saker/simulation/vehicle/vehicle_estimator.h"

#include <cmath>
#include <numbers>

namespace saker::simulation {

VehicleEstimator::VehicleEstimator(const VehicleEstimatorConfig& config)
    : config_(core::checked(config, "estimator")),
      inertial_(config.inertial),
      odometry_(config.odometry) {}

void VehicleEstimator::propagate(const lidar::ImuSample& sample, double dt) {
  now_ = sample.stamp;
  inertial_.propagate(sample, dt);
  odometry_.propagate(sample, dt);
}

SE3 VehicleEstimator::pose() const {
  SE3 T = SE3::Identity();
  T.linear() = odometry_.attitude();
  T.translation() = odometry_.position();
  return T;
}

std::optional<SE3> VehicleEstimator::receive(const VehicleOdometry& odometry) {
  if (odometry.status == VehicleOdometryStatus::lost || odometry.stamp <= last_stamp_ ||
      now_ == 0 || to_seconds(now_ - odometry.stamp) > config_.most_age_s) {
    return std::nullopt;
  }
  const double dt = to_seconds(odometry.stamp - last_stamp_);
  last_stamp_ = odometry.stamp;
  const bool first = !odometry_.started();
  if (first || odometry.reset_counter != reset_counter_) {
    const SE3 before = pose();
    odometry_.restart(odometry);
    reset_counter_ = odometry.reset_counter;
    height_offset_ = odometry.T_odom_body.translation().z() - inertial_.height();
    doubted_since_ = 0;
    return first ? std::nullopt : std::optional<SE3>(pose() * before.inverse());
  }
  OdometryDoubt doubt = contradiction(odometry, dt);
  if (doubt == nullptr) doubt = odometry_.correct(odometry);
  if (doubt == nullptr) {
    doubted_since_ = 0;
  } else {
    doubt_ = doubt;
    if (doubted_since_ == 0) doubted_since_ = now_;
  }
  return std::nullopt;
}

/// Of odometry to what the inertial unit and the barometer know without it.
OdometryDoubt VehicleEstimator::contradiction(const VehicleOdometry& odometry, double dt) {
  const Eigen::Vector3d up = odometry.T_odom_body.linear().row(2);
  const double cosine = up.dot(inertial_.attitude().row(2));
  if (!(cosine > std::cos(config_.tilt_gate_deg * std::numbers::pi / 180)))
    return "tilt contradicts the accelerometer";
  const double apart = odometry.T_odom_body.translation().z() - inertial_.height() - height_offset_;
  if (!(std::abs(apart) < config_.height_gate_m)) return "height contradicts the barometer";
  height_offset_ += std::min(1.0, dt / config_.height_time_s) * apart;
  return nullptr;
}

bool VehicleEstimator::rejected() const {
  return doubted_since_ != 0 && to_seconds(now_ - doubted_since_) > config_.doubt_time_s;
}

std::uint32_t VehicleEstimator::faults() const {
  const bool stale = !odometry_.started() || to_seconds(now_ - last_stamp_) > config_.most_age_s;
  return (stale ? kNoOdometry : 0U) | (rejected() ? kOdometryRejected : 0U);
}

}  // namespace saker::simulation
