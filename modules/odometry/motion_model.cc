#include "odometry/motion_model.h"

#include <algorithm>
#include <cmath>
#include <limits>

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

void MotionModel::start(Time moment, const SE3& T_odom_lidar) {
  moment_ = registered_moment_ = moment;
  T_odom_lidar_ = T_odom_lidar;
}

Prediction MotionModel::predict(Time moment, std::span<const lidar::ImuSample> imu) const {
  Prediction prediction;
  prediction.moment = moment;
  prediction.seconds = std::min(to_seconds(moment - moment_), config_.max_interval_s);
  prediction.rotation = gyro_.integrate(imu, moment_, moment);
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

Vector6d MotionModel::twist_to(const SE3& T_odom_lidar, double seconds) const {
  return core::se3_log(T_odom_lidar_.inverse() * T_odom_lidar) / seconds;
}

Eigen::Vector3d MotionModel::velocity_to(const SE3& T_odom_lidar, double seconds) const {
  return (T_odom_lidar.translation() - T_odom_lidar_.translation()) / seconds;
}

Sweep MotionModel::sweep(const Prediction& prediction, const SE3& T_odom_lidar, Time span,
                         std::span<const lidar::ImuSample> imu) const {
  if (span == 0) return {};
  // A mean over an interval is the rate in its middle; the scan's moment is half an interval later.
  const double seconds = prediction.seconds;
  const double between =
      moved_over_s_ > 0 ? 0.5 * (moved_over_s_ + seconds) : std::numeric_limits<double>::infinity();
  const Time begin = prediction.moment - span / 2;
  if (const auto track = gyro_.integrate(imu, begin, begin + span)) {
    const Eigen::Matrix3d R_lidar_odom = T_odom_lidar.linear().transpose();
    const Eigen::Vector3d velocity = velocity_to(T_odom_lidar, seconds);
    const Eigen::Vector3d change = (velocity - velocity_) / between;
    return Sweep::rotating(
        *track, {R_lidar_odom * (velocity + 0.5 * seconds * change), R_lidar_odom * change}, span);
  }
  const Vector6d twist = twist_to(T_odom_lidar, seconds);
  const Vector6d change = (twist - twist_) / between;
  return Sweep::twisting({twist + 0.5 * seconds * change, change}, span);
}

Sweep MotionModel::sweep_before(const Prediction& prediction, const SE3& T_odom_lidar, Time span,
                                std::span<const lidar::ImuSample> imu) const {
  if (span == 0) return {};
  const Time begin = moment_ - span / 2;
  if (const auto track = gyro_.integrate(imu, begin, begin + span)) {
    const Eigen::Vector3d velocity = velocity_to(T_odom_lidar, prediction.seconds);
    return Sweep::rotating(*track, {T_odom_lidar_.linear().transpose() * velocity}, span);
  }
  return Sweep::twisting({twist_to(T_odom_lidar, prediction.seconds)}, span);
}

void MotionModel::accept(const Prediction& prediction, const SE3& T_odom_lidar,
                         const Matrix6d& covariance) {
  const double seconds = prediction.seconds;
  if (prediction.rotation) {
    const double sd = std::sqrt(covariance.topLeftCorner<3, 3>().trace() / 3);
    gyro_.correct(prediction.rotation->R_begin_end(),
                  T_odom_lidar_.linear().transpose() * T_odom_lidar.linear(), seconds, sd);
  }
  twist_ = twist_to(T_odom_lidar, seconds);
  twist_covariance_ = covariance / (seconds * seconds);
  velocity_ = velocity_to(T_odom_lidar, seconds);
  moved_over_s_ = seconds;
  usual_interval_s_ += 0.1 * (seconds - usual_interval_s_);
  T_odom_lidar_ = T_odom_lidar;
  T_odom_lidar_.linear() =
      Eigen::Quaterniond(T_odom_lidar.linear()).normalized().toRotationMatrix();
  moment_ = registered_moment_ = prediction.moment;
}

void MotionModel::coast(const Prediction& prediction) {
  T_odom_lidar_ = prediction.prior.T_odom_lidar;
  moment_ = prediction.moment;
  twist_covariance_ = prediction.prior.covariance / (prediction.seconds * prediction.seconds);
  if (to_seconds(moment_ - registered_moment_) <= config_.max_coast_s) return;
  twist_.setZero();
  velocity_.setZero();
  moved_over_s_ = 0;
  twist_covariance_ = diagonal(config_.initial_rate_rps, config_.initial_speed_mps);
}

}  // namespace saker::odometry
