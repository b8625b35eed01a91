#include "odometry/motion_model.h"

#include <algorithm>
#include <cmath>

namespace saker::odometry {
namespace {

Matrix6d diagonal(double rotation_sd, double translation_sd) {
  Vector6d variance;
  variance.head<3>().setConstant(rotation_sd * rotation_sd);
  variance.tail<3>().setConstant(translation_sd * translation_sd);
  return variance.asDiagonal();
}

}  // namespace

MotionModel::MotionModel(const MotionConfig& config)
    : config_(config),
      gyro_(config.gyro),
      twist_covariance_(diagonal(config.initial_rate_rps, config.initial_speed_mps)) {}

void MotionModel::start(Time stamp, Time span, std::span<const lidar::ImuSample> imu) {
  stamp_ = registered_stamp_ = stamp;
  T_odom_lidar_.setIdentity();
  T_odom_lidar_.linear() = level(imu);
  first_rotation_ = gyro_.integrate(imu, stamp - span, stamp);
}

Prediction MotionModel::predict(Time stamp, std::span<const lidar::ImuSample> imu) const {
  Prediction prediction;
  prediction.stamp = stamp;
  prediction.seconds = std::min(to_seconds(stamp - stamp_), config_.max_interval_s);
  prediction.rotation = gyro_.integrate(imu, stamp_, stamp);
  SE3& T = prediction.prior.T_odom_lidar;
  if (prediction.rotation) {
    T.linear() = T_odom_lidar_.linear() * prediction.rotation->R_begin_end();
    T.translation() = T_odom_lidar_.translation() + velocity_ * prediction.seconds;
  } else {
    T = T_odom_lidar_ * core::se3_exp(twist_ * prediction.seconds);
  }
  prediction.prior.covariance =
      motion_covariance(prediction.seconds, prediction.rotation.has_value());
  return prediction;
}

Matrix6d MotionModel::motion_covariance(double seconds, bool gyro_used) const {
  // The twist is the mean of the last interval and is used for the next one: their middles are an
  // interval apart.
  const double square = seconds * seconds;
  Matrix6d covariance =
      twist_covariance_ * square +
      diagonal(config_.angular_acceleration_rps2 * square, config_.acceleration_mps2 * square);
  if (!gyro_used) return covariance;
  covariance.topRightCorner<3, 3>().setZero();
  covariance.bottomLeftCorner<3, 3>().setZero();
  covariance.topLeftCorner<3, 3>() =
      Eigen::Matrix3d::Identity() * std::pow(gyro_.rate_sd() * seconds, 2);
  return covariance;
}

Sweep MotionModel::sweep(const Prediction& prediction, const SE3& T_odom_lidar, Time span,
                         std::span<const lidar::ImuSample> imu) const {
  if (span == 0) return {};
  const double seconds = prediction.seconds;
  if (const auto track = gyro_.integrate(imu, prediction.stamp - span, prediction.stamp)) {
    const Eigen::Vector3d velocity =
        (T_odom_lidar.translation() - T_odom_lidar_.translation()) / seconds;
    const Eigen::Vector3d change =
        moved_ ? Eigen::Vector3d((velocity - velocity_) / seconds) : Eigen::Vector3d::Zero();
    const Eigen::Matrix3d R_lidar_odom = T_odom_lidar.linear().transpose();
    return Sweep::rotating(*track, {R_lidar_odom * velocity, R_lidar_odom * change, seconds}, span);
  }
  const Vector6d twist = core::se3_log(T_odom_lidar_.inverse() * T_odom_lidar) / seconds;
  const Vector6d change = moved_ ? Vector6d((twist - twist_) / seconds) : Vector6d::Zero();
  return Sweep::twisting({twist, change, seconds}, span);
}

Sweep MotionModel::first_sweep(Time span) const {
  if (span == 0 || !first_rotation_) return {};
  return Sweep::rotating(*first_rotation_, {}, span);
}

Sweep MotionModel::first_sweep(const Prediction& prediction, const SE3& T_odom_lidar,
                               Time span) const {
  if (span == 0) return {};
  const SE3 motion = T_odom_lidar_.inverse() * T_odom_lidar;
  const double seconds = prediction.seconds;
  const auto zero = Eigen::Vector3d::Zero();
  if (first_rotation_)
    return Sweep::rotating(*first_rotation_, {motion.translation() / seconds, zero, seconds}, span);
  return Sweep::twisting({core::se3_log(motion) / seconds, Vector6d::Zero(), seconds}, span);
}

void MotionModel::accept(const Prediction& prediction, const SE3& T_odom_lidar,
                         const Matrix6d& covariance) {
  const double seconds = prediction.seconds;
  const SE3 motion = T_odom_lidar_.inverse() * T_odom_lidar;
  if (prediction.rotation) {
    const double sd = std::sqrt(covariance.topLeftCorner<3, 3>().trace() / 3);
    gyro_.correct(prediction.rotation->R_begin_end(), motion.linear(), seconds, sd);
  }
  twist_ = core::se3_log(motion) / seconds;
  twist_covariance_ = covariance / (seconds * seconds);
  moved_ = true;
  velocity_ = (T_odom_lidar.translation() - T_odom_lidar_.translation()) / seconds;
  usual_interval_s_ += 0.1 * (seconds - usual_interval_s_);
  T_odom_lidar_ = T_odom_lidar;
  T_odom_lidar_.linear() =
      Eigen::Quaterniond(T_odom_lidar.linear()).normalized().toRotationMatrix();
  stamp_ = registered_stamp_ = prediction.stamp;
}

void MotionModel::coast(const Prediction& prediction) {
  T_odom_lidar_ = prediction.prior.T_odom_lidar;
  stamp_ = prediction.stamp;
  twist_covariance_ = prediction.prior.covariance / (prediction.seconds * prediction.seconds);
  if (to_seconds(stamp_ - registered_stamp_) <= config_.max_coast_s) return;
  twist_.setZero();
  velocity_.setZero();
  moved_ = false;
  twist_covariance_ = diagonal(config_.initial_rate_rps, config_.initial_speed_mps);
}

}  // namespace saker::odometry
