#include "saker/autonomy/body_pose.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace saker::autonomy {
namespace {

constexpr double kRadians = std::numbers::pi / 180;
constexpr double kMemory_s = 2;           // of samples: no scan comes so late
constexpr double kLongestAhead_s = 0.05;  // of the newest sample; then it is taken to stay
constexpr double kMostAheadOfNow_s =
    0.25;                              // a clock may lag while it follows packets that got faster
constexpr double kStartSpeed_mps = 1;  // sd at the first scan: on the ground, or in a hand
/// Of a place, squared, in sd. By the configured noise it were 3 on average; registration errs by a
/// third of that or less: 0.3 at most in made flights.
constexpr double kSurprising = 2;

Matrix6d diagonal(double rotation_sd, double translation_sd) {
  Vector6d variance;
  variance.head<3>().setConstant(rotation_sd * rotation_sd);
  variance.tail<3>().setConstant(translation_sd * translation_sd);
  return variance.asDiagonal();
}

}  // namespace

BodyPose::BodyPose(const BodyPoseConfig& config, const odometry::InertialConfig& inertial,
                   const SE3& T_body_lidar)
    : config_(core::checked(config, "body_pose")),
      T_body_lidar_(T_body_lidar),
      scan_noise_(diagonal(config.sd_rotation_deg * kRadians, config.sd_position_m)),
      scan_(inertial),
      newest_(inertial) {}

void BodyPose::add(const lidar::ImuSample& sample, Time now) {
  if (to_seconds(sample.stamp) - to_seconds(now) > kMostAheadOfNow_s) return;
  if (!sample.acceleration.allFinite() || !sample.angular_velocity.allFinite()) return;
  const double memory_s = std::max(config_.coast_s, kMemory_s);
  imu_.add({&sample, 1}, std::max(scan_.stamp(), sample.stamp - from_seconds(memory_s)));
  if (started_) newest_.propagate(sample);
}

void BodyPose::correct(Time stamp, const SE3& T_odom_lidar, const Matrix6d& covariance) {
  if (started_ && stamp <= scan_.stamp()) return;
  if (!T_odom_lidar.matrix().allFinite() || !covariance.allFinite()) return;
  const Matrix6d noise = scan_noise_ + covariance;
  if (!started_) {
    scan_.start(stamp, T_odom_lidar, noise, Eigen::Vector3d::Zero(), kStartSpeed_mps);
    started_ = true;
  } else {
    scan_.propagate(imu_.samples(), stamp);
    if (jumped(scan_.T_odom_lidar(), T_odom_lidar)) {
      ++reset_counter_;
      scan_.jump(T_odom_lidar, noise);
      off_.setZero();
    } else {
      weigh(T_odom_lidar, noise);
      scan_.correct(T_odom_lidar, noise);
    }
  }
  newest_ = scan_;
  for (const lidar::ImuSample& sample : imu_.samples()) newest_.propagate(sample);
}

/// Before a correction.
void BodyPose::weigh(const SE3& measured, const Matrix6d& noise) {
  const odometry::InertialFilter::Surprise surprise = scan_.surprise(measured, noise);
  const bool large = surprise.square > kSurprising;
  if (large && off_.dot(surprise.off) > 0) scan_.doubt(surprise, noise);
  off_ = large ? surprise.off : Eigen::Vector3d(Eigen::Vector3d::Zero());
}

bool BodyPose::jumped(const SE3& predicted, const SE3& measured) const {
  const SE3 off = predicted.inverse() * measured;
  return off.translation().norm() > config_.jump_m ||
         core::so3_log(off.linear()).norm() > config_.jump_deg * kRadians;
}

VehicleOdometry BodyPose::at(Time now) const {
  VehicleOdometry result;
  result.stamp = now;
  result.reset_counter = reset_counter_;
  if (!started_) return result;
  const Time newest = newest_.stamp();
  // A pose that stays must not claim to be of now: who flies by it would take it for a lie.
  result.stamp = std::min(now, newest + from_seconds(kLongestAhead_s));
  odometry::InertialFilter lidar = newest_;
  lidar.coast(result.stamp);
  const SE3 T_lidar_body = T_body_lidar_.inverse();
  result.T_odom_body = lidar.T_odom_lidar() * T_lidar_body;
  result.velocity = lidar.velocity() +
                    lidar.T_odom_lidar().linear() * lidar.rate().cross(T_lidar_body.translation());
  result.angular_velocity = T_body_lidar_.linear() * lidar.rate();
  const Matrix6d to_body = core::se3_adjoint(T_body_lidar_);
  result.covariance = to_body * lidar.pose_covariance() * to_body.transpose();
  result.status = status(now, result.covariance);
  return result;
}

VehicleOdometryStatus BodyPose::status(Time now, const Matrix6d& covariance) const {
  const double age = to_seconds(now - scan_.stamp());
  const bool heard = std::abs(to_seconds(now - newest_.stamp())) <= kLongestAhead_s;
  if (age <= config_.fresh_s && heard) return VehicleOdometryStatus::ok;
  const double sd = std::sqrt(covariance.bottomRightCorner<3, 3>().trace());
  const bool coasts = heard && age <= config_.coast_s && sd <= config_.coast_sd_m;
  const bool known = age <= config_.lost_s || coasts;
  return known ? VehicleOdometryStatus::predicted : VehicleOdometryStatus::lost;
}

}  // namespace saker::autonomy
