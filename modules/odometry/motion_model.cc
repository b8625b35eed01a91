#include "saker/odometry/motion_model.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>

#include "saker/odometry/rotation_track.h"

namespace saker::odometry {
namespace {

Matrix6d diagonal(double rotation_sd, double translation_sd) {
  Vector6d variance;
  variance.head<3>().setConstant(rotation_sd * rotation_sd);
  variance.tail<3>().setConstant(translation_sd * translation_sd);
  return variance.asDiagonal();
}

/// Of the samples within the interval.
Eigen::Vector3d mean_force(std::span<const lidar::ImuSample> imu, Time begin, Time end) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  int count = 0;
  for (const lidar::ImuSample& sample : imu) {
    if (sample.stamp < begin || sample.stamp > end || !sample.acceleration.allFinite()) continue;
    sum += sample.acceleration;
    ++count;
  }
  return sum / std::max(count, 1);
}

double mean_sd(const Matrix6d& covariance) {
  return std::sqrt(covariance.bottomRightCorner<3, 3>().trace() / 3);
}

double speed_sd(const InertialFilter& inertial) {
  return std::sqrt(inertial.covariance().block<3, 3>(6, 6).trace() / 3);
}

/// What the way from a pose of this covariance added to that of the prior, where both errors go on
/// from one scan to the next: sums over scans hold.
Matrix6d growth(const Matrix6d& before, const PosePrior& prior) {
  const Matrix6d sum = prior.covariance - before;
  const Eigen::SelfAdjointEigenSolver<Matrix6d> solver(0.5 * (sum + sum.transpose()));
  return solver.eigenvectors() * solver.eigenvalues().cwiseMax(0).asDiagonal() *
         solver.eigenvectors().transpose();
}

constexpr double kLonger = 1.5;  // usual intervals: more than jitter

}  // namespace

MotionModel::MotionModel(const MotionConfig& config)
    : config_(config),
      inertial_(config.inertial),
      twist_covariance_(diagonal(config.initial_rate_rps, config.initial_speed_mps)) {}

void MotionModel::start(Time moment, const SE3& T_odom_lidar) {
  moment_ = registered_moment_ = moment;
  T_odom_lidar_ = T_odom_registered_ = T_odom_lidar;
  inertial_.start(moment, T_odom_lidar, Matrix6d::Zero(), Eigen::Vector3d::Zero(),
                  config_.initial_speed_mps);
}

bool MotionModel::covered(std::span<const lidar::ImuSample> imu, Time begin, Time end) const {
  return covers(imu, begin, end, config_.inertial.max_gap_s);
}

Prediction MotionModel::predict(Time moment, std::span<const lidar::ImuSample> imu) const {
  const double seconds = to_seconds(moment - registered_moment_);
  if (!covered(imu, moment_, moment)) return by_twist(moment, seconds);
  Prediction prediction;
  prediction.moment = moment;
  prediction.seconds = seconds;
  InertialFilter ahead = inertial_, from_here = inertial_;
  ahead.propagate(imu, moment);
  from_here.fix_pose();
  from_here.propagate(imu, moment);
  prediction.prior = {ahead.T_odom_lidar(), ahead.pose_covariance()};
  prediction.motion_covariance = moment_ == registered_moment_
                                     ? from_here.pose_covariance()
                                     : growth(inertial_.pose_covariance(), prediction.prior);
  prediction.inertial = ahead;
  return prediction;
}

Prediction MotionModel::predict_without_imu(Time moment) const {
  return by_twist(moment, to_seconds(moment - registered_moment_));
}

std::optional<Prediction> MotionModel::predict_stepped(
    Time moment, std::span<const lidar::ImuSample> imu) const {
  const bool longer = to_seconds(moment - registered_moment_) > kLonger * usual_interval_s_;
  if (!longer || covered(imu, registered_moment_, moment)) return std::nullopt;
  return by_twist(moment, usual_interval_s_);
}

Prediction MotionModel::by_twist(Time moment, double seconds) const {
  Prediction prediction;
  prediction.moment = moment;
  prediction.seconds = seconds;
  const double moves = std::min(seconds, std::max(config_.max_coast_s, usual_interval_s_));
  prediction.prior.T_odom_lidar = T_odom_registered_ * core::se3_exp(twist_ * moves);
  prediction.prior.covariance = prediction.motion_covariance = twist_motion_covariance(seconds);
  const double before = to_seconds(moment_ - registered_moment_);
  if (before > 0)
    prediction.motion_covariance = growth(twist_motion_covariance(before), prediction.prior);
  return prediction;
}

/// Up to where nothing but the speed of a multirotor bounds it.
Matrix6d MotionModel::twist_motion_covariance(double seconds) const {
  // The twist is the mean of the last interval and is used for the next one.
  const double square = seconds * seconds;
  const double change = 0.5 * seconds * (seconds + std::max(seconds, moved_over_s_));
  const Matrix6d any =
      diagonal(config_.initial_rate_rps * seconds, config_.initial_speed_mps * seconds);
  const Matrix6d twist =
      twist_covariance_ * square +
      diagonal(config_.angular_acceleration_rps2 * change, config_.acceleration_mps2 * change);
  return twist.trace() < any.trace() || moved_over_s_ == 0 ? twist : any;
}

Vector6d MotionModel::twist_to(const SE3& T_odom_lidar, double seconds) const {
  return core::se3_log(T_odom_registered_.inverse() * T_odom_lidar) / seconds;
}

Eigen::Vector3d MotionModel::velocity_to(const SE3& T_odom_lidar, double seconds) const {
  return (T_odom_lidar.translation() - T_odom_registered_.translation()) / seconds;
}

Sweep MotionModel::sweep(const Prediction& prediction, const SE3& T_odom_lidar, Time span,
                         std::span<const lidar::ImuSample> imu) const {
  if (span == 0) return {};
  const Time begin = prediction.moment - span / 2, end = begin + span;
  if (prediction.inertial && covered(imu, begin, end)) {
    const InertialFilter& inertial = *prediction.inertial;
    return Sweep::rotating(RotationTrack::integrated(imu, begin, end, inertial.rate_bias()),
                           {T_odom_lidar.linear().transpose() * inertial.velocity_at(T_odom_lidar),
                            inertial.acceleration(mean_force(imu, begin, end))},
                           span);
  }
  // A mean over an interval is the rate in its middle; the scan's moment is half an interval later.
  const double seconds = prediction.seconds;
  const double between =
      moved_over_s_ > 0 ? 0.5 * (moved_over_s_ + seconds) : std::numeric_limits<double>::infinity();
  const Vector6d twist = twist_to(T_odom_lidar, seconds);
  const Vector6d change = (twist - twist_) / between;
  return Sweep::twisting({twist + 0.5 * seconds * change, change}, span);
}

Sweep MotionModel::sweep_before(const SE3& T_odom_lidar, double seconds, Time span,
                                std::span<const lidar::ImuSample> imu) const {
  if (span == 0) return {};
  const Time begin = moment_ - span / 2, end = begin + span;
  if (covered(imu, begin, end)) {
    const Eigen::Vector3d velocity = velocity_to(T_odom_lidar, seconds);
    return Sweep::rotating(RotationTrack::integrated(imu, begin, end, inertial_.rate_bias()),
                           {T_odom_lidar_.linear().transpose() * velocity}, span);
  }
  return Sweep::twisting({twist_to(T_odom_lidar, seconds)}, span);
}

Matrix6d MotionModel::half_sweep_covariance(const Prediction& prediction, Time span) const {
  const double unseen_s = std::max(0.0, prediction.seconds - kLonger * usual_interval_s_);
  if (prediction.inertial || unseen_s == 0) return Matrix6d::Zero();
  const double half_s = to_seconds(span) / 2;
  const double rate =
      std::min(config_.initial_rate_rps, config_.angular_acceleration_rps2 * unseen_s);
  const double speed = std::min(config_.initial_speed_mps, config_.acceleration_mps2 * unseen_s);
  return diagonal(rate * half_s, speed * half_s);
}

void MotionModel::accept(const Prediction& prediction, const SE3& T_odom_lidar,
                         const Matrix6d& covariance) {
  const double seconds = prediction.seconds;
  twist_ = twist_to(T_odom_lidar, seconds);
  twist_covariance_ = covariance / (seconds * seconds);
  const Eigen::Vector3d velocity = velocity_to(T_odom_lidar, seconds);
  moved_over_s_ = seconds;
  if (moment_ == registered_moment_) usual_interval_s_ += 0.1 * (seconds - usual_interval_s_);
  T_odom_lidar_ = T_odom_lidar;
  T_odom_lidar_.linear() =
      Eigen::Quaterniond(T_odom_lidar.linear()).normalized().toRotationMatrix();
  T_odom_registered_ = T_odom_lidar_;
  moment_ = registered_moment_ = prediction.moment;
  if (prediction.inertial) {
    inertial_ = *prediction.inertial;
    inertial_.condition(T_odom_lidar_, covariance);
  } else {
    inertial_.start(moment_, T_odom_lidar_, covariance, velocity,
                    mean_sd(prediction.prior.covariance) / seconds);
  }
}

void MotionModel::coast(const Prediction& prediction) {
  T_odom_lidar_ = prediction.prior.T_odom_lidar;
  moment_ = prediction.moment;
  if (prediction.inertial && speed_sd(*prediction.inertial) < config_.initial_speed_mps) {
    inertial_ = *prediction.inertial;
    return;
  }
  inertial_.start(moment_, T_odom_lidar_, prediction.prior.covariance,
                  velocity_to(T_odom_lidar_, prediction.seconds), config_.initial_speed_mps);
}

}  // namespace saker::odometry
